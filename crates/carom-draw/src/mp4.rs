//! A film as MP4: frames go through a pipe to the program `ffmpeg`, if it is there.
use crate::raster::Canvas;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::thread::{self, JoinHandle};

/// What to do without ffmpeg.
pub const MISSING: &str = "an .mp4 is packed by the program ffmpeg, which is not on the PATH; install it (Debian: apt install ffmpeg, \
                           macOS: brew install ffmpeg), or write a .gif";

/// A film under way.
pub struct Mp4 {
    child: Child,
    said: Option<JoinHandle<String>>,
    /// Even, as the format wants it.
    size: [usize; 2],
    row: Vec<u8>,
}

impl Mp4 {
    /// A film of this size and so many frames per second, written to `path`.
    ///
    /// # Errors
    /// [`io::ErrorKind::NotFound`] without ffmpeg, and whatever else keeps it from starting.
    pub fn new(size: [usize; 2], rate: f64, path: &Path) -> io::Result<Self> {
        let size = size.map(|n| n & !1);
        let mut child = Command::new("ffmpeg")
            .args(["-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"])
            .args(["-s", &format!("{}x{}", size[0], size[1]), "-r", &format!("{rate}"), "-i", "-"])
            .args(["-an", "-c:v", "libx264", "-crf", "18", "-preset", "medium", "-pix_fmt", "yuv420p"])
            .args(["-movflags", "+faststart", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-f", "mp4"])
            .arg(path)
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|e| if e.kind() == io::ErrorKind::NotFound { io::Error::new(e.kind(), MISSING) } else { e })?;
        let said = child.stderr.take().map(|pipe| thread::spawn(move || read(pipe)));
        Ok(Self { child, said, size, row: Vec::new() })
    }

    /// The next frame.
    ///
    /// # Errors
    /// What ffmpeg said if it ended early, or what the pipe says.
    pub fn frame(&mut self, canvas: &Canvas) -> io::Result<()> {
        let [width, _] = canvas.size();
        self.row.clear();
        for y in 0..self.size[1] {
            let row = &canvas.pixels()[4 * y * width..4 * (y * width + self.size[0])];
            self.row.extend(row.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]));
        }
        let Some(pipe) = self.child.stdin.as_mut() else { return Ok(()) };
        match pipe.write_all(&self.row) {
            Err(e) if e.kind() == io::ErrorKind::BrokenPipe => self.end(),
            other => other,
        }
    }

    /// The end: waits until ffmpeg has written the file.
    ///
    /// # Errors
    /// What ffmpeg said.
    pub fn finish(mut self) -> io::Result<()> {
        self.end()
    }

    fn end(&mut self) -> io::Result<()> {
        drop(self.child.stdin.take());
        let status = self.child.wait()?;
        let said = self.said.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let said = said.lines().last().unwrap_or("no reason given").trim().to_owned();
        if status.success() { Ok(()) } else { Err(io::Error::other(format!("ffmpeg failed: {said}"))) }
    }
}

impl Drop for Mp4 {
    fn drop(&mut self) {
        // Cut short: ffmpeg is not left behind.
        if self.child.stdin.take().is_some() {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// What is said, the last of it.
fn read(mut pipe: ChildStderr) -> String {
    const MOST: usize = 4096;
    let mut all = Vec::new();
    let mut some = [0; 1024];
    while let Ok(n @ 1..) = pipe.read(&mut some) {
        all.extend_from_slice(&some[..n]);
        if all.len() > MOST {
            all.drain(..all.len() - MOST);
        }
    }
    String::from_utf8_lossy(&all).into_owned()
}
