//! Pictures, films and plots: what the commands write, and what they refuse.
mod said;
use assert_cmd::cargo::cargo_bin_cmd;
use said::said;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("pictures-{name}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn carom_in(folder: &Path, line: &str, stdin: &str) -> Output {
    let mut command = cargo_bin_cmd!("carom");
    command.current_dir(folder).args(line.split_whitespace()).write_stdin(stdin).output().unwrap()
}

fn well(folder: &Path, line: &str, stdin: &str) {
    let output = carom_in(folder, line, stdin);
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
}

/// What a refused command says; nothing may be left behind.
fn refused_in(folder: &Path, line: &str) -> String {
    let before = fs::read_dir(folder).unwrap().count();
    let output = carom_in(folder, line, "");
    let err = String::from_utf8(output.stderr).unwrap();
    println!("{line}\n{err}");
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert!(!err.contains("panicked"));
    assert_eq!(fs::read_dir(folder).unwrap().count(), before, "{line}");
    err
}

/// The number of frames of a GIF, how long they last (hundredths of a second) without the last, and its size.
fn frames(path: &Path) -> (u32, u32, [u16; 2]) {
    let mut decoder = gif::DecodeOptions::new().read_info(fs::File::open(path).unwrap()).unwrap();
    let size = [decoder.width(), decoder.height()];
    let (mut count, mut sum, mut last) = (0, 0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        (count, last) = (count + 1, u32::from(frame.delay));
        sum += last;
    }
    (count, sum - last, size)
}

#[test]
fn every_kind_of_picture_in_every_dimension_twice_the_same() {
    let folder = folder("kinds");
    for scene in ["two-balls", "oblique", "drop", "space"] {
        let line = format!("render {scene} --size 200x150 --fps 10 --arrows v,p,J --trails --theme dark");
        well(&folder, &format!("{line} -o a.svg -o a.png -o a.gif"), "");
        well(&folder, &format!("{line} -o b.svg -o b.png -o b.gif"), "");
        for (kind, starts) in [("svg", &b"<svg "[..]), ("png", b"\x89PNG\r\n"), ("gif", b"GIF89a")] {
            let [a, b] = ["a", "b"].map(|name| fs::read(folder.join(format!("{name}.{kind}"))).unwrap());
            assert!(a.starts_with(starts) && a == b, "{scene} {kind}");
        }
        assert_eq!(frames(&folder.join("a.gif")).2, [200, 150]);
    }
}

#[test]
fn a_film_has_the_frames_and_the_length_that_were_asked_for() {
    let folder = folder("film");
    // A second of the scene in two seconds of film, 20 frames each: 40 steps, and the start.
    well(&folder, "render two-balls -o a.gif --size 160x120 --speed 0.5 --fps 20 --until time=1", "");
    assert_eq!(frames(&folder.join("a.gif")), (41, 200, [160, 120]));
    // A sixtieth of a second is not a whole number of hundredths: the sum is right all the same.
    well(&folder, "render two-balls -o b.gif --size 160x120 --speed 1 --fps 60 --until time=1", "");
    assert_eq!(frames(&folder.join("b.gif")), (61, 100, [160, 120]));
    // A run that goes on for long after its last impact, at 0.45 s, is shown until soon after it.
    well(&folder, "render two-balls -o c.gif --size 160x120 --speed 0.1 --fps 10 --set run.until={time=1000.0}", "");
    let (count, ..) = frames(&folder.join("c.gif"));
    assert!((60..80).contains(&count), "{count}");
}

#[test]
fn a_run_writes_pictures_too_and_is_the_same_run() {
    let folder = folder("run");
    let scene = said("scenes wall", "") + "[[output]]\npath = \"film.gif\"\nevery = { time = 0.1 }\n";
    let output = carom_in(&folder, "run - --format json -o end.png -o end.svg", &scene);
    assert!(output.status.success(), "{output:?}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report, said::run("wall", ""));
    // 3 s at steps of 0.1 s, and the start; ten frames a second.
    let (count, length, _) = frames(&folder.join("film.gif"));
    assert_eq!((count, length), (31, 300));
    assert!(folder.join("end.png").exists() && folder.join("end.svg").exists());
    let scene = said("scenes wall", "") + "[[output]]\npath = \"a.png\"\nevery = { time = 0.1 }\n";
    let output = carom_in(&folder, "run -", &scene);
    assert!(output.status.code() == Some(2) && String::from_utf8_lossy(&output.stderr).contains("every"));
}

#[test]
fn what_makes_no_picture_is_told() {
    let folder = folder("refused");
    for (line, says) in [
        ("render two-balls", "--output"),
        ("render two-balls -o a.csv", "carom run two-balls -o a.csv"),
        ("render two-balls -o a", ".svg, .png, .gif or .mp4"),
        ("render two-balls -o a.gif --at 0.1", "--until time=S"),
        ("render two-balls -o a.gif --strobe", "--trails"),
        ("render two-balls -o a.png -o a.png", "twice"),
        ("render two-balls -o a.png --size 10x10", "1280x720"),
        ("render two-balls -o a.png --size 99999x99999", "16384"),
        ("render two-balls -o a.png --at=-1", "not negative"),
        ("render two-balls -o a.gif --fps 0", "from 1 to 240"),
        ("render two-balls -o a.gif --speed 0.0000001", "--speed"),
        ("render two-balls -o no/such/folder/a.png", "no/such/folder"),
        ("render two-bals -o a.png", "`two-balls`"),
        ("plot two-balls", "--what"),
        ("plot two-balls --what energy -o a.gif", ".svg or a .png"),
        ("plot two-balls --what colour", "spacetime"),
    ] {
        assert!(refused_in(&folder, line).contains(says), "{line}");
    }
}

#[cfg(unix)]
#[test]
fn an_mp4_goes_through_ffmpeg_or_says_that_it_is_missing() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder("mp4");
    let mut command = cargo_bin_cmd!("carom");
    let output = command
        .current_dir(&folder)
        .env("PATH", folder.join("nothing"))
        .args(["render", "two-balls", "-o", "a.mp4"])
        .output()
        .unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(err.contains("ffmpeg") && err.contains(".gif"), "{err}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    // A program of that name that keeps what it is given.
    let bin = folder.join("bin");
    fs::create_dir(&bin).unwrap();
    fs::write(bin.join("ffmpeg"), "#!/bin/sh\nfor last; do :; done\ncat > \"$last\"\n").unwrap();
    fs::set_permissions(bin.join("ffmpeg"), fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let film = |line: &str| {
        let mut command = cargo_bin_cmd!("carom");
        command.current_dir(&folder).env("PATH", &path).args(line.split_whitespace()).output().unwrap()
    };
    let output = film("render two-balls -o a.mp4 --size 161x121 --speed 1 --fps 10 --until time=1");
    assert!(output.status.success(), "{output:?}");
    // Eleven frames of 160 x 120 pixels (even, as the format wants it), three bytes each.
    assert_eq!(fs::metadata(folder.join("a.mp4")).unwrap().len(), 11 * 160 * 120 * 3);
    fs::write(bin.join("ffmpeg"), "#!/bin/sh\necho 'no such codec' >&2\nexit 1\n").unwrap();
    let output = film("render two-balls -o b.mp4 --size 160x120");
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no such codec"));
    assert!(!folder.join("b.mp4").exists());
}

#[test]
fn plots_in_files_and_in_the_terminal() {
    let folder = folder("plots");
    for what in ["energy", "momentum", "speed", "gaps", "spacetime"] {
        for scene in ["two-balls", "bounce", "space"] {
            let text = said(&format!("plot {scene} --what {what}"), "");
            println!("{text}");
            assert!(text.lines().count() > 18 && text.lines().all(|l| l.chars().count() <= 100), "{scene} {what}");
            well(&folder, &format!("plot {scene} --what {what} -o a.svg -o a.png --size 300x200"), "");
            let text = fs::read_to_string(folder.join("a.svg")).unwrap();
            assert!(text.starts_with("<svg ") && !text.contains("NaN") && !text.contains("inf"), "{scene} {what}");
            assert!(fs::read(folder.join("a.png")).unwrap().starts_with(b"\x89PNG"));
        }
    }
}
