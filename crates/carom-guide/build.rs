//! Gathers the Rust blocks of the guide and the README into one file of tests: one program to compile instead of one a block.
use std::fmt::Write;
use std::path::Path;

#[path = "src/markdown.rs"]
#[allow(dead_code)]
mod markdown;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let guide = root.join("guide");
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/markdown.rs");
    println!("cargo::rerun-if-changed={}", guide.display());
    println!("cargo::rerun-if-changed={}", root.join("README.md").display());
    let mut pages = markdown::pages(&guide);
    pages.push(root.join("README.md"));
    let mut tests = String::new();
    let mut count = 0;
    for path in pages {
        println!("cargo::rerun-if-changed={}", path.display());
        let page = std::fs::read_to_string(&path).expect("a page that was listed");
        let name = path.strip_prefix(&root).unwrap_or(&path).display().to_string();
        for block in markdown::blocks(&page).iter().filter(|b| b.language == "rust") {
            let test: String =
                name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
            let _ = writeln!(tests, "/// `{name}`, line {}.\n#[test]\n#[allow(unused)]", block.line);
            let _ = writeln!(tests, "fn {test}_{}() -> Result<(), Box<dyn std::error::Error>> {{", block.line);
            for line in block.text.lines() {
                // Hidden lines, as in the documentation of Rust.
                let line = if line == "#" { "" } else { line.strip_prefix("# ").unwrap_or(line) };
                let _ = writeln!(tests, "    {line}");
            }
            tests += "    #[allow(unreachable_code)]\n    Ok(())\n}\n\n";
            count += 1;
        }
    }
    let _ = writeln!(tests, "/// How many there are.\npub const BLOCKS: usize = {count};");
    let out = std::env::var("OUT_DIR").expect("cargo says where");
    std::fs::write(Path::new(&out).join("blocks.rs"), tests).expect("cargo's own folder");
}
