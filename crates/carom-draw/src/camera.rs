//! From space to the sheet: a camera that stands a little above, far enough for a quiet perspective.
use crate::cast::Cast;
use crate::sheet::{At, Window};
use crate::view::Region;
use carom_scene::Point;

/// How high the camera stands, and how far round (degrees).
const HIGH: f64 = 20.0;
const ROUND: f64 = -62.0;
/// How far away it stands, in diagonals of what it sees.
const AWAY: f64 = 2.4;

/// A camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    centre: Point,
    right: Point,
    up: Point,
    /// Towards the camera.
    towards: Point,
    away: f64,
    /// Where the centre falls on the sheet, and pixels per metre there.
    middle: At,
    scale: f64,
    /// The axis that points up, and whether its positive end does.
    pub vertical: (usize, bool),
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

impl Camera {
    /// A camera that sees a region; the sheet is not laid out yet. Up is where gravity does not pull, else z.
    pub fn new(cast: &Cast, region: &Region) -> Self {
        let g = cast.gravity;
        let axis = (0..3).fold(2, |best, k| if g[k].abs() > g[best].abs() { k } else { best });
        let positive = !(g[axis] > 0.0);
        let sky: Point = std::array::from_fn(|k| if k == axis { if positive { 1.0 } else { -1.0 } } else { 0.0 });
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let (high, round) = (HIGH.to_radians(), ROUND.to_radians());
        let mut towards = sky.map(|x| x * libm::sin(high));
        towards[a] += libm::cos(high) * libm::cos(round);
        towards[b] += libm::cos(high) * libm::sin(round) * if positive { 1.0 } else { -1.0 };
        let right = unit(cross(sky, towards));
        let diagonal = (0..3).map(|k| region.size(k) * region.size(k)).sum::<f64>().sqrt();
        Self {
            centre: std::array::from_fn(|k| 0.5 * (region.low[k] + region.high[k])),
            right,
            up: cross(towards, right),
            towards,
            away: AWAY * if diagonal > 0.0 { diagonal } else { 1.0 },
            middle: [0.0, 0.0],
            scale: 1.0,
            vertical: (axis, positive),
        }
    }

    /// The rectangle on the sheet that some points fill.
    pub fn frame(&self, points: &[Point]) -> Window {
        let start = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        points.iter().map(|p| self.at(*p)).fold(start, |w, [x, y]| [w[0].min(x), w[1].min(y), w[2].max(x), w[3].max(y)])
    }

    /// The same camera, with these points filling the stage.
    pub fn on(mut self, points: &[Point], stage: Window) -> Self {
        let seen = self.frame(points);
        let scale = ((stage[2] - stage[0]) / (seen[2] - seen[0])).min((stage[3] - stage[1]) / (seen[3] - seen[1]));
        let middle = |k: usize| 0.5 * (stage[k] + stage[k + 2]) - scale * 0.5 * (seen[k] + seen[k + 2]);
        self.middle = [middle(0), middle(1)];
        self.scale = scale;
        self
    }

    /// How near a point is (m, larger is nearer).
    pub fn near(&self, p: Point) -> f64 {
        dot(self.off_centre(p), self.towards)
    }

    fn off_centre(&self, p: Point) -> Point {
        std::array::from_fn(|k| p[k] - self.centre[k])
    }

    fn magnify(&self, p: Point) -> f64 {
        // What lies behind the camera is as large as what is nearly in it.
        self.away / (self.away - self.near(p)).max(0.05 * self.away)
    }

    /// A point's place.
    pub fn at(&self, p: Point) -> At {
        let (d, m) = (self.off_centre(p), self.magnify(p) * self.scale);
        [self.middle[0] + dot(d, self.right) * m, self.middle[1] - dot(d, self.up) * m]
    }

    /// Pixels per metre at a point.
    pub fn scale(&self, p: Point) -> f64 {
        self.scale * self.magnify(p)
    }

    /// Half the diagonal of what it was made to see (m).
    pub fn depth(&self) -> f64 {
        0.5 * self.away / AWAY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom_scene::{Document, builtin};

    #[test]
    fn near_is_large_up_is_up_and_all_is_on_the_stage() {
        let document = Document::parse("spheres", builtin("spheres").unwrap()).unwrap();
        let scene = document.scene().unwrap();
        let cast = Cast::new(&scene, &document.plan(&scene).unwrap(), "spheres");
        let region = Region { low: [0.0; 3], high: [10.0, 10.0, 10.0] };
        let corners: Vec<Point> =
            (0..8).map(|k| std::array::from_fn(|i| if k >> i & 1 == 1 { 10.0 } else { 0.0 })).collect();
        let camera = Camera::new(&cast, &region).on(&corners, [0.0, 0.0, 800.0, 600.0]);
        for c in &corners {
            let [x, y] = camera.at(*c);
            assert!((-1e-9..=800.0 + 1e-9).contains(&x) && (-1e-9..=600.0 + 1e-9).contains(&y), "{c:?} {x} {y}");
        }
        assert!(camera.at([5.0, 5.0, 9.0])[1] < camera.at([5.0, 5.0, 1.0])[1], "z points up");
        let (a, b) = (corners[0], corners[7]);
        assert_eq!(camera.near(a) > camera.near(b), camera.scale(a) > camera.scale(b));
    }
}
