//! `carom lab`: the browser lab, served from the binary to this machine only.
use crate::link::encode;
use crate::source::{Changes, Source};
use crate::trouble::{Trouble, print};
use clap::Args;
use flate2::read::GzDecoder;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::time::Duration;

include!(concat!(env!("OUT_DIR"), "/page.rs"));

const AFTER: &str = "\
The page is part of the program and asks no other machine for anything. It is served to this machine only, until Ctrl-C.

Examples:
  carom lab
  carom lab cradle
  carom lab my-scene.toml --no-open";

/// Serve the lab to the browser of this machine
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Lab {
    /// The scene to begin with: a file (.toml or .json), - for standard input, or a built-in one (`carom scenes`)
    scene: Option<String>,
    /// The port [default: 4177, or a free one if that is taken]
    #[arg(long, value_name = "P")]
    port: Option<u16>,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
    #[command(flatten)]
    changes: Changes,
}

/// A file of the page: address, content by gzip, and by brotli if there is that.
type File = (&'static str, &'static [u8], Option<&'static [u8]>);

/// The port that is tried first.
const PORT: u16 = 4177;
/// The longest request that is read (bytes): browsers send a few hundred.
const LONGEST: u64 = 16 << 10;
/// How long a browser may take to ask or to listen.
const PATIENCE: Duration = Duration::from_secs(10);
/// Nothing from anywhere else, and no script that is not a file of the page.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; \
     style-src 'self'; font-src 'self'; img-src 'self' blob: data:; manifest-src 'self'; base-uri 'none'; form-action 'none'";

impl Lab {
    pub fn run(self) -> Result<(), Trouble> {
        let fragment = match &self.scene {
            None if !self.changes.is_empty() => {
                return Err(Trouble::usage("--set and --until change a scene; name one, as in carom lab cradle"));
            }
            None => String::new(),
            Some(name) if self.changes.is_empty() && carom_scene::builtin(name).is_some() => {
                // A file goes before a built-in scene of the same name.
                match std::path::Path::new(name).exists() {
                    true => format!("#{}", self.packed(name.clone())?),
                    false => format!("#{name}"),
                }
            }
            Some(name) => format!("#{}", self.packed(name.clone())?),
        };
        if FILES.is_empty() {
            return Err(Trouble::usage(
                "the page of the lab is not in this build of carom\n\
                 help: in a clone of the project, `lab/build` makes it (needs Node and a toolchain for wasm); then build carom again",
            ));
        }
        let listener = listen(self.port)?;
        let port = listener.local_addr().map(|a| a.port()).unwrap_or(PORT);
        let url = format!("http://127.0.0.1:{port}/{fragment}");
        print(&format!("Carom Lab: {url}\nCtrl-C ends it.\n"))?;
        if !self.no_open {
            open(&url);
        }
        for stream in listener.incoming().flatten() {
            std::thread::spawn(move || answer(&stream, port));
        }
        Ok(())
    }

    fn packed(&self, scene: String) -> Result<String, Trouble> {
        let ready = Source { scene, changes: self.changes.clone() }.ready()?;
        Ok(encode(&ready.scene))
    }
}

/// On the loopback only: no other machine can reach it.
fn listen(port: Option<u16>) -> Result<TcpListener, Trouble> {
    let bind = |port: u16| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    match port {
        Some(port) => bind(port).map_err(|e| Trouble::usage(format!("--port {port}: cannot listen: {e}"))),
        None => bind(PORT)
            .or_else(|e| if e.kind() == ErrorKind::AddrInUse { bind(0) } else { Err(e) })
            .map_err(|e| Trouble::usage(format!("cannot listen on port {PORT}: {e}; --port picks another"))),
    }
}

/// Asks the system to open a browser. Where there is none, the address has been printed.
fn open(url: &str) {
    let (program, arguments): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("explorer", &[]),
        _ => ("xdg-open", &[]),
    };
    let quiet = std::process::Stdio::null;
    let _ = std::process::Command::new(program)
        .args(arguments)
        .arg(url)
        .stdin(quiet())
        .stdout(quiet())
        .stderr(quiet())
        .spawn();
}

/// The file of an address, without what follows `?`.
fn file(target: &str) -> Option<&'static File> {
    let path = target.split(['?', '#']).next().unwrap_or_default().trim_start_matches('/');
    let path = if path.is_empty() { "index.html" } else { path };
    FILES.iter().find(|f| f.0 == path)
}

fn kind(name: &str) -> &'static str {
    match name.rsplit_once('.').map_or("", |(_, extension)| extension) {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "woff2" => "font/woff2",
        "svg" => "image/svg+xml",
        "json" | "webmanifest" => "application/json",
        _ => "application/octet-stream",
    }
}

/// What a request asks for.
struct Request {
    method: String,
    target: String,
    host: String,
    gzip: bool,
    brotli: bool,
}

fn read(stream: &TcpStream) -> Option<Request> {
    let mut lines = BufReader::new(stream.take(LONGEST)).lines();
    let first = lines.next()?.ok()?;
    let mut words = first.split(' ');
    let mut request = Request {
        method: words.next()?.into(),
        target: words.next()?.into(),
        host: String::new(),
        gzip: false,
        brotli: false,
    };
    for line in lines {
        let line = line.ok()?;
        if line.is_empty() {
            return Some(request);
        }
        let (name, value) = line.split_once(':')?;
        match name.to_ascii_lowercase().as_str() {
            "host" => request.host = value.trim().to_ascii_lowercase(),
            "accept-encoding" => {
                let known = value.to_ascii_lowercase();
                let known =
                    |name: &str| known.split(',').any(|part| part.split(';').next().unwrap_or("").trim() == name);
                (request.gzip, request.brotli) = (known("gzip"), known("br"));
            }
            _ => {}
        }
    }
    None
}

fn answer(mut stream: &TcpStream, port: u16) {
    let _ = stream.set_read_timeout(Some(PATIENCE));
    let _ = stream.set_write_timeout(Some(PATIENCE));
    let Some(request) = read(stream) else { return };
    // A page of another host that was given this machine's address must not get in.
    let ours = ["127.0.0.1", "localhost"].iter().any(|name| request.host == format!("{name}:{port}"));
    let (status, found) = match (ours, request.method.as_str(), file(&request.target)) {
        (false, ..) => ("403 Forbidden", None),
        (_, "GET" | "HEAD", Some(found)) => ("200 OK", Some(found)),
        (_, "GET" | "HEAD", None) => ("404 Not Found", None),
        _ => ("405 Method Not Allowed", None),
    };
    let mut plain = Vec::new();
    let (name, body, encoding) = match found {
        Some((name, _, Some(packed))) if request.brotli => (*name, *packed, "content-encoding: br\r\n"),
        Some((name, packed, _)) if request.gzip => (*name, *packed, "content-encoding: gzip\r\n"),
        Some((name, packed, _)) => {
            let _ = GzDecoder::new(*packed).read_to_end(&mut plain);
            (*name, &plain[..], "")
        }
        None => ("", &b""[..], ""),
    };
    let head = format!(
        "HTTP/1.1 {status}\r\ncontent-type: {}\r\ncontent-length: {}\r\n{encoding}content-security-policy: {POLICY}\r\n\
         x-content-type-options: nosniff\r\nreferrer-policy: no-referrer\r\ncache-control: no-cache\r\nconnection: close\r\n\r\n",
        kind(name),
        body.len()
    );
    let sent = stream.write_all(head.as_bytes());
    if sent.is_ok() && request.method != "HEAD" {
        let _ = stream.write_all(body);
    }
    let _ = stream.flush();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_have_their_types() {
        assert_eq!(kind("assets/index-1.js"), "text/javascript; charset=utf-8");
        assert_eq!(kind("carom-1d.wasm"), "application/wasm");
        assert_eq!(kind("LICENSE"), "application/octet-stream");
    }

    #[test]
    fn only_files_of_the_page_are_served() {
        for target in ["/../Cargo.toml", "/etc/passwd", "/assets", "//"] {
            assert!(file(target).is_none_or(|f| f.0 == "index.html" && target == "//"), "{target}");
        }
        assert_eq!(file("/").is_some(), file("/index.html?embed=1").is_some());
    }
}
