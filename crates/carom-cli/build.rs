//! Puts what `lab/build` made into the binary, compressed: by gzip, and what it packed by brotli (`.br`) in that form as well. Where it was not run there is nothing to put in, and `carom lab` says
//! which command makes the page.
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    let here = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(env::var("OUT_DIR").unwrap_or_default());
    let dist = here.join("../../lab/dist");
    println!("cargo:rerun-if-changed=build.rs");
    // What does not exist counts as changed every time. `lab/build` writes the engine into `public` first, and that tells.
    println!("cargo:rerun-if-changed={}", here.join("../../lab/public").display());
    if dist.is_dir() {
        println!("cargo:rerun-if-changed={}", dist.display());
    }
    let mut files = Vec::new();
    if dist.join("index.html").is_file() {
        collect(&dist, &dist, &mut files);
    }
    files.sort();
    let mut table = String::from(
        "/// The files of the page: address, content compressed by gzip, and by brotli where the build did that.\n\
         pub static FILES: &[File] = &[\n",
    );
    for (k, (name, path)) in files.iter().enumerate() {
        if name.ends_with(".br") {
            continue;
        }
        let Ok(content) = fs::read(path) else { continue };
        let smaller = files.iter().find(|f| f.0.strip_suffix(".br") == Some(name));
        let smaller = match smaller.and_then(|f| f.1.canonicalize().ok()) {
            Some(path) => format!("Some(include_bytes!({:?}))", path.display().to_string()),
            None => "None".into(),
        };
        let packed = out.join(format!("page-{k}.gz"));
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        let bytes = encoder.write_all(&content).and_then(|()| encoder.finish());
        if bytes.and_then(|bytes| fs::write(&packed, bytes)).is_ok() {
            let _ = writeln!(table, "    ({name:?}, include_bytes!({:?}), {smaller}),", packed.display().to_string());
        }
    }
    table += "];\n";
    fs::write(out.join("page.rs"), table).unwrap_or_else(|e| panic!("cannot write {}: {e}", out.display()));
}

fn collect(root: &Path, folder: &Path, files: &mut Vec<(String, PathBuf)>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(root, &path, files);
        } else if let Ok(relative) = path.strip_prefix(root) {
            let name: Vec<_> = relative.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            files.push((name.join("/"), path));
        }
    }
}
