//! Times of impact against `tools/toi_oracle.py`: brute force with 60 digits.
use carom::Vector;
use carom::meet::{self, Arc, Path};
use serde_json::Value;

/// A case: how it was made, its numbers, how the event comes about, its time, the closing speed, the curvature of the gap.
struct Case<'a> {
    row: &'a [Value],
    style: &'a str,
    event: &'a str,
    time: f64,
    speed: f64,
    curvature: f64,
}

impl<'a> Case<'a> {
    fn new(row: &'a Value) -> Self {
        let row = row.as_array().expect("a row");
        let n = row.len();
        Self {
            row,
            style: row[0].as_str().expect("a style"),
            event: row[n - 4].as_str().expect("an event"),
            time: row[n - 3].as_f64().unwrap_or(f64::INFINITY),
            speed: number(&row[n - 2]),
            curvature: number(&row[n - 1]),
        }
    }

    fn number(&self, k: usize) -> f64 {
        number(&self.row[k + 1])
    }

    fn path<const D: usize>(&self) -> Path<D> {
        Path::new(vector::<D>(&self.row[1]), vector::<D>(&self.row[2]), vector::<D>(&self.row[3]))
    }

    fn shape(&self, k: usize) -> &Value {
        &self.row[4][k]
    }

    fn radius(&self) -> f64 {
        self.number(4)
    }

    fn dimensions(&self) -> usize {
        self.row[1].as_array().map_or(1, Vec::len)
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn vector<const D: usize>(value: &Value) -> Vector<D> {
    Vector::from_fn(|k| number(&value[k]))
}

/// What a case gives: the time, and a length and a speed that bound those on the way (m, m/s), and the smallest radius of
/// curvature (m).
struct Answer {
    time: f64,
    length: f64,
    speed: f64,
    radius: f64,
}

fn answer<const D: usize>(time: f64, expected: f64, path: &Path<D>, size: f64, radius: f64) -> Answer {
    let t = if expected.is_finite() { expected } else { 0.0 };
    let (speed, pull) = (path.velocity.norm(), path.acceleration.norm());
    Answer {
        time,
        length: path.position.norm() + speed * t + 0.5 * pull * t * t + size + radius,
        speed: speed + pull * t,
        radius,
    }
}

/// How many roundings the engine may take, in units of epsilon times the largest length on the way. A position is a sum of
/// three terms and a difference from the obstacle, each rounded to half a unit; projecting it and taking the distance adds as
/// much again: 5 in all if none cancels. Close to grazing a root moves by twice its first-order error at most.
const ROUNDINGS: f64 = 10.0;

fn run(table: &str, mut solve: impl FnMut(&Case<'_>) -> Answer) {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/toi.json")).expect("toi.json");
    let all: Value = serde_json::from_str(&text).expect("JSON");
    let rows = all[table].as_array().expect("a table");
    let (mut events, mut misses) = (0, 0);
    let (mut largest, mut worst, mut worst_turn) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (k, row) in rows.iter().enumerate() {
        let case = Case::new(row);
        let found = solve(&case);
        events += usize::from(case.time.is_finite());
        if found.time.is_finite() != case.time.is_finite() {
            misses += 1;
            println!("{table} {k} {}: {} is not {} ({})", case.style, found.time, case.time, case.event);
            continue;
        }
        if !case.time.is_finite() || found.time == case.time {
            continue;
        }
        // The time itself is rounded, by us and by the oracle.
        let off = ((found.time - case.time).abs() - f64::EPSILON * case.time).max(0.0);
        largest = largest.max(off * found.speed / found.length);
        let roundings = if case.event == "turn" {
            // The rate p.w / |p| is off by the roundings of the length, over the distance, times the speed.
            let turn = off * case.curvature / (f64::EPSILON * found.speed * (1.0 + found.length / found.radius));
            worst_turn = worst_turn.max(turn);
            turn
        } else if case.event == "kink" {
            // The centre passes from one part's region to the next.
            off * found.speed / (f64::EPSILON * found.length)
        } else {
            let root = off * case.speed / (f64::EPSILON * found.length);
            worst = worst.max(root);
            root
        };
        if !(roundings <= ROUNDINGS) {
            misses += 1;
            println!(
                "{table} {k} {}: {} is not {} ({}): {roundings:.1} roundings",
                case.style, found.time, case.time, case.event
            );
        }
    }
    println!(
        "{table:>22}: {:4} cases, {events:4} events, {misses} wrong; dt speed / length <= {largest:.1e}; \
         roots <= {worst:.2}, turning points <= {worst_turn:.2} roundings",
        rows.len()
    );
    assert_eq!(misses, 0, "{table}");
}

#[test]
fn two_balls() {
    fn solve<const D: usize>(case: &Case<'_>) -> Answer {
        let (x, v) = (vector::<D>(&case.row[1]), vector::<D>(&case.row[2]));
        let radius = case.number(2);
        answer(meet::ball_ball(x, v, radius), case.time, &Path::new(x, v, [0.0; D]), 0.0, radius)
    }
    run("ball_ball", |case| match case.dimensions() {
        1 => solve::<1>(case),
        2 => solve::<2>(case),
        _ => solve::<3>(case),
    });
}

#[test]
fn two_balls_without_acceleration_by_the_other_way() {
    fn solve<const D: usize>(case: &Case<'_>) -> Answer {
        let path = Path::new(vector::<D>(&case.row[1]), vector::<D>(&case.row[2]), [0.0; D]);
        let radius = case.number(2);
        answer(meet::ball_ball_accelerated(&path, radius), case.time, &path, 0.0, radius)
    }
    run("ball_ball", |case| match case.dimensions() {
        1 => solve::<1>(case),
        2 => solve::<2>(case),
        _ => solve::<3>(case),
    });
}

#[test]
fn two_balls_accelerated() {
    fn solve<const D: usize>(case: &Case<'_>) -> Answer {
        let path = case.path::<D>();
        answer(meet::ball_ball_accelerated(&path, case.radius()), case.time, &path, 0.0, case.radius())
    }
    run("ball_ball_accelerated", |case| match case.dimensions() {
        1 => solve::<1>(case),
        2 => solve::<2>(case),
        _ => solve::<3>(case),
    });
}

#[test]
fn planes() {
    run("plane", |case| {
        let [height, speed, acceleration, radius] = [0, 1, 2, 3].map(|k| case.number(k));
        let time = meet::plane(height, speed, acceleration, radius);
        answer(time, case.time, &Path::new([height], [speed], [acceleration]), 0.0, radius)
    });
}

#[test]
fn cells() {
    run("exit", |case| {
        let [position, speed, acceleration, low, high] = [0, 1, 2, 3, 4].map(|k| case.number(k));
        let time = meet::exit(position, speed, acceleration, low, high);
        answer(time, case.time, &Path::new([position], [speed], [acceleration]), low.abs() + high.abs(), 0.0)
    });
}

fn segment<const D: usize>(case: &Case<'_>) -> Answer {
    let (path, from, to) = (case.path::<D>(), vector::<D>(case.shape(0)), vector::<D>(case.shape(1)));
    let time = meet::segment(&path, from, to, case.radius());
    answer(time, case.time, &path, from.norm() + to.norm(), case.radius())
}

#[test]
fn segments_in_the_plane() {
    run("segment", segment::<2>);
}

#[test]
fn segments_in_space() {
    run("wire", segment::<3>);
}

#[test]
fn arcs() {
    run("arc", |case| {
        let [radius, from, to] = [1, 2, 3].map(|k| number(case.shape(k)));
        let arc = Arc::new(vector::<2>(case.shape(0)), radius, from, to);
        let time = meet::arc(&case.path(), &arc, case.radius());
        answer(
            time,
            case.time,
            &case.path::<2>(),
            arc.centre().norm() + radius * (1.0 + from.abs().max(to.abs())),
            case.radius(),
        )
    });
}

#[test]
fn triangles() {
    run("triangle", |case| {
        let corners = [0, 1, 2].map(|k| vector::<3>(case.shape(k)));
        let time = meet::triangle(&case.path(), corners, case.radius());
        // A face is known as well as its longest edge is to its height.
        let edges = [0, 1, 2].map(|k| corners[(k + 1) % 3] - corners[k]);
        let longest = edges.iter().map(|e| e.norm()).fold(0.0, f64::max);
        let e = edges[0].unit().expect("an edge");
        let area = (edges[2] - e * edges[2].dot(e)).norm() * edges[0].norm();
        let size = corners.iter().map(|c| c.norm()).sum::<f64>();
        answer(time, case.time, &case.path::<3>(), size + longest * longest * longest / area, case.radius())
    });
}
