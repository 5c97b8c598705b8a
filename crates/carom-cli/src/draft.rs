//! A file that appears under its name when it is complete: what is under way lies beside.
use crate::trouble::Trouble;
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A file under way. Dropped before it is [completed](Draft::complete) it leaves nothing behind.
pub struct Draft {
    /// As it was asked for.
    name: String,
    to: PathBuf,
    /// Where it is written before it is complete; `None` for what cannot be replaced, such as a pipe.
    beside: Option<PathBuf>,
    /// `None` while it is [closed](Draft::close).
    file: Option<BufWriter<File>>,
}

impl Draft {
    /// Starts a file of this name.
    pub fn create(name: &str) -> Result<Self, Trouble> {
        // A link stays a link: what it points to is replaced.
        let to = fs::canonicalize(name).unwrap_or_else(|_| PathBuf::from(name));
        let special = fs::metadata(&to).is_ok_and(|m| !m.is_file());
        if to.is_dir() {
            return Err(Trouble::usage(format!("cannot write {name}: it is a folder")));
        }
        let beside = (!special).then(|| beside(&to));
        let file = match &beside {
            Some(path) => File::create(path),
            None => fs::OpenOptions::new().write(true).open(&to),
        };
        let file = BufWriter::new(file.map_err(|e| Trouble::unwritten(name, &e))?);
        Ok(Self { name: name.to_owned(), to, beside, file: Some(file) })
    }

    /// The name that was asked for.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where it is written: for a program that writes it in place of this one.
    pub fn path(&self) -> &Path {
        self.beside.as_ref().unwrap_or(&self.to)
    }

    /// Completes the file, and puts it in its place.
    pub fn complete(mut self) -> io::Result<()> {
        self.place()
    }

    /// Writes what is kept back and closes the file, which still waits to be completed: thousands may wait so.
    pub fn close(&mut self) -> io::Result<()> {
        self.flush()?;
        self.file = None;
        Ok(())
    }

    /// Puts the file in its place as it is, to be written on.
    pub fn go_on(mut self) -> io::Result<File> {
        self.place()?;
        let file = self.file.take().ok_or_else(closed)?;
        file.into_inner().map_err(io::IntoInnerError::into_error)
    }

    fn place(&mut self) -> io::Result<()> {
        self.flush()?;
        if let Some(path) = &self.beside {
            fs::rename(path, &self.to)?;
        }
        self.beside = None;
        Ok(())
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_mut().ok_or_else(closed)?.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_mut().map_or(Ok(()), Write::flush)
    }
}

impl Seek for Draft {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.as_mut().ok_or_else(closed)?.seek(to)
    }
}

fn closed() -> io::Error {
    io::Error::other("the file is closed already")
}

impl Drop for Draft {
    fn drop(&mut self) {
        // Cut short: nothing half written is left.
        if let Some(path) = self.beside.take() {
            let _ = fs::remove_file(path);
        }
    }
}

/// The name beside a file under which it is written.
pub fn beside(to: &Path) -> PathBuf {
    let mut name = to.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".part-{}", std::process::id()));
    to.with_file_name(name)
}
