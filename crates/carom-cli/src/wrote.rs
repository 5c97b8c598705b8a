//! What was written, in a line on standard error: pipelines do not see it.
use crate::figures::digits;
use std::io::Write;
use std::{fs, io};

/// Says that a file is there, what it holds and how large it is. Of a pipe or a device there is nothing to say.
pub fn wrote(name: &str, what: &str) {
    let Ok(file) = fs::metadata(name) else { return };
    if file.is_file() {
        let what = if what.is_empty() { String::new() } else { format!("{what}, ") };
        let _ = writeln!(io::stderr(), "wrote {name}: {what}{}", size(file.len()));
    }
}

/// A number of bytes, as people say it.
fn size(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{} kB", digits(bytes as f64 / 1e3, 3)),
        1_000_000..1_000_000_000 => format!("{} MB", digits(bytes as f64 / 1e6, 3)),
        _ => format!("{} GB", digits(bytes as f64 / 1e9, 3)),
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn sizes_are_said_in_three_digits() {
        for (bytes, said) in
            [(0, "0 bytes"), (999, "999 bytes"), (1234, "1.23 kB"), (56_789_000, "56.8 MB"), (7_000_000_000, "7 GB")]
        {
            assert_eq!(super::size(bytes), said);
        }
    }
}
