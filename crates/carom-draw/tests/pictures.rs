//! Pictures hold what they show, and small ones are the same bytes on every machine.
use carom::{Rotates, Vector};
use carom_draw::gif::Gif;
use carom_draw::palette::Census;
use carom_draw::theme::Paper;
use carom_draw::{Arrows, Cast, Drawing, Hit, Look, Snapshot, Survey, Trace, still};
use carom_scene::{Document, build, builtin};

struct Seen {
    drawing: Drawing,
    frames: Vec<(Snapshot, Trace)>,
}

/// A built-in scene, seen at some times; the last is the end.
fn seen<const D: usize>(name: &str, look: Look, times: &[f64]) -> Seen
where
    Vector<D>: Rotates,
{
    let document = Document::parse(name, builtin(name).unwrap()).unwrap();
    let scene = document.scene().unwrap();
    let plan = document.plan(&scene).unwrap();
    let cast = Cast::new(&scene, &plan, name);
    let mut world = build::<D>(&scene, &plan).unwrap();
    let (mut survey, mut whole) = (Survey::default(), Trace::new(f64::INFINITY, 0.0));
    let mut trace = Trace::new(look.memory(), look.flash());
    let mut frames = Vec::new();
    for time in times {
        world.advance_to(*time);
        for impact in world.impacts() {
            let hit = Hit::of(impact);
            survey.hit(&hit);
            whole.hit(&hit, &cast);
            trace.hit(&hit, &cast);
        }
        let snapshot = Snapshot::of(&world);
        survey.look(&snapshot, &cast);
        whole.look(&snapshot, &cast);
        trace.look(&snapshot, &cast);
        frames.push((snapshot, trace.clone()));
    }
    Seen { drawing: Drawing::new(cast, look, survey, whole), frames }
}

fn small() -> Look {
    Look { size: Some([320, 200]), ..Look::default() }
}

/// FNV-1a, 64 bits.
fn digest(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
}

fn svg(seen: &Seen) -> String {
    let (snapshot, trace) = seen.frames.last().unwrap();
    seen.drawing.svg(snapshot, trace)
}

fn png(seen: &Seen) -> Vec<u8> {
    let (snapshot, trace) = seen.frames.last().unwrap();
    let mut canvas = seen.drawing.canvas().unwrap();
    canvas.draw(&seen.drawing.frame(snapshot, trace));
    let mut bytes = Vec::new();
    still::png(&canvas, &mut bytes).unwrap();
    bytes
}

fn film(seen: &Seen) -> Vec<u8> {
    let ground = seen.drawing.canvas().unwrap();
    let mut canvas = ground.copy();
    let mut census = Census::default();
    for (snapshot, trace) in &seen.frames {
        canvas.draw(&seen.drawing.frame(snapshot, trace));
        census.count(canvas.pixels());
        canvas.restore(&ground);
    }
    let mut gif = Gif::new(canvas.size(), &census, Vec::new());
    for (k, (snapshot, trace)) in seen.frames.iter().enumerate() {
        canvas.restore(&ground);
        canvas.draw(&seen.drawing.frame(snapshot, trace));
        gif.frame(&canvas, k as f64 / 25.0).unwrap();
    }
    gif.finish(seen.frames.len() as f64 / 25.0).unwrap()
}

/// The numbers behind `key="` in a document.
fn values(text: &str, key: &str) -> Vec<f64> {
    let key = format!(" {key}=\"");
    text.split(&key).skip(1).filter_map(|rest| rest.split('"').next()?.parse().ok()).collect()
}

#[test]
fn bodies_stand_where_they_are() {
    // A starts at -1 with 3 m/s, B at 1 with -1 m/s: at 0.2 s they are at -0.4 and 0.8, of radius 0.1.
    let seen = seen::<1>("two-balls", small(), &[0.0, 0.2]);
    let text = svg(&seen);
    let (x, r) = (values(&text, "cx"), values(&text, "r"));
    println!("{x:?} {r:?}");
    let ball = r[..4].iter().copied().fold(0.0, f64::max);
    let at: Vec<f64> = x.iter().zip(&r).filter(|p| *p.1 == ball).map(|p| *p.0).collect();
    // A hundredth of a pixel is all that is written.
    assert!(((at[1] - at[0]) / (ball / 0.1) - 1.2).abs() < 1e-3, "{at:?} {ball}");
}

#[test]
fn a_film_shows_the_frames_that_were_drawn() {
    let times: Vec<f64> = (0..12).map(|k| 0.05 * f64::from(k)).collect();
    let seen = seen::<2>("break", Look { film: true, trails: true, pace: 0.5, ..small() }, &times);
    let bytes = film(&seen);
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    let mut screen = vec![0u8; 4 * 320 * 200];
    let (mut count, mut delay) = (0, 0);
    let ground = seen.drawing.canvas().unwrap();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        for (k, pixel) in frame.buffer.chunks(4).enumerate().filter(|(_, p)| p[3] > 0) {
            let (x, y) = (k % usize::from(frame.width), k / usize::from(frame.width));
            let at = 4 * ((y + usize::from(frame.top)) * 320 + x + usize::from(frame.left));
            screen[at..at + 4].copy_from_slice(pixel);
        }
        let mut canvas = ground.copy();
        let (snapshot, trace) = &seen.frames[count];
        canvas.draw(&seen.drawing.frame(snapshot, trace));
        // 255 colours for all: nowhere far from what was drawn, and on the average next to nothing.
        let far = |k: usize| f64::from(screen[k].abs_diff(canvas.pixels()[k]));
        let worst = (0..screen.len()).map(far).fold(0.0, f64::max);
        let mean = (0..screen.len()).map(far).sum::<f64>() / screen.len() as f64;
        assert!(worst <= 64.0 && mean < 0.3, "frame {count}: {worst} {mean}");
        count += 1;
        delay += u32::from(frame.delay);
    }
    assert_eq!((count, delay), (12, 48), "twelve frames of 0.04 s");
}

#[test]
fn images_of_a_body_are_drawn_on_both_sides_of_a_periodic_box() {
    let text = "carom = 1\n[world]\ndim = 2\nboundary = { kind = \"periodic\", min = [0, 0], max = [1, 1] }\n\
                [[body]]\nmass = 1\nradius = 0.1\nposition = [0.0, 0.5]\n[run]\nuntil = { time = 1.0 }\n";
    let document = Document::parse("image", text).unwrap();
    let scene = document.scene().unwrap();
    let plan = document.plan(&scene).unwrap();
    let cast = Cast::new(&scene, &plan, "image");
    let world = build::<2>(&scene, &plan).unwrap();
    let snapshot = Snapshot::of(&world);
    let mut survey = Survey::default();
    survey.look(&snapshot, &cast);
    let drawing = Drawing::new(cast, small(), survey, Trace::default());
    let text = drawing.svg(&snapshot, &Trace::default());
    let (x, r) = (values(&text, "cx"), values(&text, "r"));
    let discs: Vec<f64> = x.iter().zip(&r).filter(|p| *p.1 > 5.0).map(|p| *p.0).collect();
    let r = r.iter().copied().fold(0.0, f64::max);
    assert!(discs.iter().any(|x| (x - discs[0] - 10.0 * r).abs() < 0.1), "{discs:?} {r}");
}

/// Size and digest of small pictures: a change of the size says that the writing changed, the digest alone that a number did.
#[test]
fn small_pictures_are_the_same_bytes_everywhere() {
    let times: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
    let arrows = Arrows { velocity: true, momentum: true, impulse: true };
    let dark = Look { paper: Paper::Dark, arrows, ..small() };
    let two = seen::<1>("two-balls", small(), &times);
    let oblique = seen::<2>("oblique", dark.clone(), &times);
    let marble = seen::<2>("marble", Look { trails: true, ..small() }, &times);
    let bounce = seen::<2>("bounce", Look { strobe: true, ..small() }, &times);
    let spheres = seen::<3>("spheres", Look { arrows: Arrows::default(), ..dark }, &[0.0, 0.01]);
    let film_of = seen::<2>("break", Look { film: true, ..small() }, &times);
    let all: [(&str, Vec<u8>); 8] = [
        ("two-balls.svg", svg(&two).into_bytes()),
        ("two-balls.png", png(&two)),
        ("oblique.svg", svg(&oblique).into_bytes()),
        ("oblique.png", png(&oblique)),
        ("marble.png", png(&marble)),
        ("bounce.svg", svg(&bounce).into_bytes()),
        ("spheres.png", png(&spheres)),
        ("break.gif", film(&film_of)),
    ];
    let got: Vec<(&str, usize, String)> =
        all.iter().map(|(name, bytes)| (*name, bytes.len(), format!("{:016x}", digest(bytes)))).collect();
    if let Ok(folder) = std::env::var("CAROM_PICTURES") {
        all.iter().for_each(|(name, bytes)| std::fs::write(format!("{folder}/{name}"), bytes).unwrap());
    }
    println!("{got:#?}");
    let want: Vec<(&str, usize, String)> = include_str!("pictures.txt")
        .lines()
        .filter_map(|line| {
            let mut words = line.split_whitespace();
            Some((words.next()?, words.next()?.parse().ok()?, words.next()?.to_owned()))
        })
        .collect();
    assert_eq!(got, want, "look at the pictures (CAROM_PICTURES=folder keeps them) before you change pictures.txt");
}
