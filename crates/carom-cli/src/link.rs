//! `carom link`: a scene as a link to the lab, and back. The whole scene is in the fragment, `#1.` and the deflated JSON in
//! base64url, so that no server ever sees it.
use crate::source::{Changes, Source};
use crate::trouble::{Trouble, print};
use carom_scene::model::Scene;
use carom_scene::{Detail, Document, Format, to_json, to_toml};
use clap::Args;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;
use std::io::{Read, Write};

/// The version of links that is written, and the newest that is read.
const VERSION: u32 = 1;
/// No scene that a link holds is longer (bytes); a bomb is.
const LONGEST: u64 = 4 << 20;
/// Where `carom lab` serves the page unless told otherwise.
pub const HOME: &str = "http://127.0.0.1:4177/";

const AFTER: &str = "\
The link opens in any copy of the lab: `carom lab`, or wherever its files are served.

Examples:
  carom link cradle
  carom link my-scene.toml --set material.default.restitution=0.5
  carom link my-scene.toml --base https://example.org/lab/
  carom link --open 'http://127.0.0.1:4177/#1.q1YqSy0qzszPU7Iy1FFQKi7JLEoFsWsB' > scene.toml";

/// A scene as a link to the lab, or a link as a scene
#[derive(Args)]
#[command(after_help = AFTER)]
pub struct Link {
    /// A file (.toml or .json), - for standard input, or the name of a built-in scene (`carom scenes`)
    #[arg(required_unless_present = "open", conflicts_with = "open")]
    scene: Option<String>,
    /// Print the scene of this link as TOML
    #[arg(long, value_name = "URL")]
    open: Option<String>,
    /// The address of the lab
    #[arg(long, value_name = "URL", default_value = HOME)]
    base: String,
    #[command(flatten)]
    changes: Changes,
}

impl Link {
    pub fn run(self) -> Result<(), Trouble> {
        if let Some(url) = &self.open {
            let text = decode(url).map_err(|m| Trouble::usage(format!("--open: {m}")))?;
            let document = Document::parse_as("link", &text, Format::Json).map_err(Trouble::scene)?;
            let scene = document.scene().map_err(Trouble::scene)?;
            return print(&to_toml(&scene, Detail::Short));
        }
        let ready = Source { scene: self.scene.unwrap_or_default(), changes: self.changes }.ready()?;
        let base = self.base.split('#').next().unwrap_or_default();
        print(&format!("{base}#{}\n", encode(&ready.scene)))
    }
}

/// The fragment of a scene, without `#`.
pub fn encode(scene: &Scene) -> String {
    let mut encoder = DeflateEncoder::new(Vec::new(), flate2::Compression::best());
    // Writing to memory does not fail.
    let packed = encoder.write_all(to_json(scene, Detail::Short).as_bytes()).and_then(|()| encoder.finish());
    format!("{VERSION}.{}", base64url(&packed.unwrap_or_default()))
}

/// The JSON of a link or of its fragment; or what is wrong with it.
fn decode(url: &str) -> Result<String, String> {
    let fragment = url.split_once('#').map_or(url, |(_, fragment)| fragment);
    let fragment = fragment.split('&').next().unwrap_or_default();
    let Some((version, data)) = fragment.split_once('.') else {
        return Err("this is no link of the lab: it has `#1.` and then the scene".into());
    };
    match version.parse::<u32>() {
        Ok(VERSION) => {}
        Ok(newer) if newer > VERSION => {
            return Err(format!(
                "the link is of format {newer}, and this program knows formats up to {VERSION}; a newer carom reads it"
            ));
        }
        _ => {
            return Err(format!("`{version}` is no format of a link; the lab writes `#{VERSION}.` and then the scene"));
        }
    }
    let damaged = "the link is damaged: a part of it may be missing";
    let bytes = unbase64url(data).ok_or(damaged)?;
    let mut text = String::new();
    DeflateDecoder::new(&bytes[..]).take(LONGEST + 1).read_to_string(&mut text).map_err(|_| damaged)?;
    if text.len() as u64 > LONGEST {
        return Err(format!("the scene of the link is longer than {LONGEST} bytes"));
    }
    Ok(text)
}

const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// RFC 4648, section 5, without padding.
fn base64url(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = chunk.iter().fold(0u32, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - chunk.len()));
        for k in 0..=chunk.len() {
            text.push(DIGITS[(word >> (18 - 6 * k)) as usize & 63] as char);
        }
    }
    text
}

fn unbase64url(text: &str) -> Option<Vec<u8>> {
    let digits: Option<Vec<u32>> =
        text.bytes().map(|c| DIGITS.iter().position(|d| *d == c).map(|d| d as u32)).collect();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 3);
    for chunk in digits?.chunks(4) {
        if chunk.len() == 1 {
            return None;
        }
        let word = chunk.iter().fold(0u32, |word, digit| word << 6 | digit) << (6 * (4 - chunk.len()));
        bytes.extend(&word.to_be_bytes()[1..chunk.len()]);
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom_scene::{builtin, builtins};

    #[test]
    fn base64url_of_the_rfc() {
        // RFC 4648, section 10, without padding; and the two digits that differ from base64.
        for (plain, coded) in
            [("", ""), ("f", "Zg"), ("fo", "Zm8"), ("foo", "Zm9v"), ("foob", "Zm9vYg"), ("fooba", "Zm9vYmE")]
        {
            assert_eq!(base64url(plain.as_bytes()), coded);
            assert_eq!(unbase64url(coded).unwrap(), plain.as_bytes());
        }
        assert_eq!(base64url(&[0xfb, 0xff]), "-_8");
        assert_eq!(unbase64url("A"), None);
        assert_eq!(unbase64url("A+/="), None);
    }

    #[test]
    fn every_scene_survives_its_link() {
        for b in builtins() {
            let document = Document::parse(b.name, builtin(b.name).unwrap()).unwrap();
            let scene = document.scene().unwrap();
            let link = format!("{HOME}#{}", encode(&scene));
            let back = Document::parse_as("link", &decode(&link).unwrap(), Format::Json).unwrap().scene().unwrap();
            assert_eq!(to_json(&back, Detail::Full), to_json(&scene, Detail::Full), "{}", b.name);
        }
    }

    #[test]
    fn wrong_links_are_refused_in_words() {
        for (link, word) in [
            ("http://x/", "no link"),
            ("http://x/#2.abc", "newer"),
            ("#x.abc", "no format"),
            ("#1.abc", "damaged"),
            ("#1.!", "damaged"),
        ] {
            let message = decode(link).unwrap_err();
            assert!(message.contains(word), "{link}: {message}");
        }
    }
}
