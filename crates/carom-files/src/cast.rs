//! Who plays in a run, and where everybody is at one time.

/// A body of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Actor {
    /// Its name.
    pub name: String,
    /// Its kind, from 1: the place in [`Cast::kinds`].
    pub kind: u32,
    /// Mass (kg); `None` of a fixed body without one.
    pub mass: Option<f64>,
    /// Radius (m).
    pub radius: f64,
}

impl Actor {
    /// The mass (kg) for formats that have no word for none: 0.
    pub fn mass_or_zero(&self) -> f64 {
        self.mass.unwrap_or(0.0)
    }
}

/// The edge of a world: infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The lower corner (m).
    pub min: [f64; 3],
    /// The upper corner (m).
    pub max: [f64; 3],
    /// Along these axes the box closes on itself.
    pub periodic: [bool; 3],
}

impl Bounds {
    /// No edge.
    pub fn open() -> Self {
        Self { min: [f64::NEG_INFINITY; 3], max: [f64::INFINITY; 3], periodic: [false; 3] }
    }
}

/// What stays the same over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Cast {
    /// The scene's title.
    pub title: String,
    /// 1, 2 or 3.
    pub dim: usize,
    /// Kinds of bodies: a name for each group, and for each body that is in none.
    pub kinds: Vec<String>,
    /// The bodies, in the order of their ids.
    pub bodies: Vec<Actor>,
    /// The edge.
    pub bounds: Bounds,
}

impl Default for Cast {
    fn default() -> Self {
        Self { title: String::new(), dim: 3, kinds: Vec::new(), bodies: Vec::new(), bounds: Bounds::open() }
    }
}

/// Where a body is, and how it moves. Components beyond the world's dimension are zero; a spin of the plane is about z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Position of the centre (m).
    pub position: [f64; 3],
    /// Velocity (m/s).
    pub velocity: [f64; 3],
    /// Spin (rad/s).
    pub spin: [f64; 3],
}

/// All bodies at one time, in the order of the cast.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The number of the frame, from 0.
    pub number: u64,
    /// The time (s).
    pub time: f64,
    /// The bodies.
    pub bodies: &'a [Moment],
}

impl Cast {
    /// The lower and the upper corner (m) of a box around a frame: the world's edge where it has one; else around the bodies;
    /// across a world of fewer than three dimensions, as thick as its largest body.
    pub fn cell(&self, frame: &Frame<'_>) -> ([f64; 3], [f64; 3]) {
        let largest = self.bodies.iter().map(|b| b.radius).fold(0.0, f64::max);
        let largest = if largest > 0.0 { largest } else { 0.5 };
        let (mut low, mut high) = (self.bounds.min, self.bounds.max);
        for k in 0..3 {
            if k >= self.dim {
                (low[k], high[k]) = (-largest, largest);
                continue;
            }
            let ends = self.bodies.iter().zip(frame.bodies).map(|(actor, at)| (at.position[k], actor.radius));
            let ends = ends.filter(|(x, _)| x.is_finite());
            let (least, most) = ends
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), (x, r)| (least.min(x - r), most.max(x + r)));
            let (least, most) = if least < most { (least, most) } else { (-largest, largest) };
            low[k] = if low[k].is_finite() { low[k] } else { least.min(high[k]) };
            high[k] = if high[k].is_finite() { high[k] } else { most.max(low[k]) };
            if !(low[k] < high[k]) {
                (low[k], high[k]) = (low[k] - largest, low[k] + largest);
            }
        }
        (low, high)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Two bodies in a box that is periodic along x, with numbers that single precision does not hold.
    pub(crate) fn two() -> (Cast, [Moment; 2]) {
        let actor = |name: &str, kind, mass, radius| Actor { name: name.into(), kind, mass, radius };
        let cast = Cast {
            title: "Two".into(),
            dim: 2,
            kinds: vec!["A".into(), "disc".into()],
            bodies: vec![actor("A", 1, Some(0.1), 0.5), actor("disc-1", 2, None, 0.25)],
            bounds: Bounds {
                min: [-1.0, -1.0, f64::NEG_INFINITY],
                max: [3.0, 2.0, f64::INFINITY],
                periodic: [true, false, false],
            },
        };
        let third = 1.0 / 3.0;
        let first = Moment { position: [third, 1e-17, 0.0], velocity: [-0.1, 1e300, 0.0], spin: [0.0, 0.0, third] };
        let second = Moment { position: [2.0 - third, 1.0 + f64::EPSILON, 0.0], ..Moment::default() };
        (cast, [first, second])
    }

    #[test]
    fn a_cell_is_the_edge_where_there_is_one_and_around_the_bodies_elsewhere() {
        let actor = Actor { name: "a".into(), kind: 1, mass: Some(1.0), radius: 0.25 };
        let mut cast = Cast { dim: 2, bodies: vec![actor.clone(), actor], ..Cast::default() };
        let at = |x, y| Moment { position: [x, y, 0.0], ..Moment::default() };
        let bodies = [at(-1.0, 0.0), at(3.0, 0.5)];
        let frame = Frame { number: 0, time: 0.0, bodies: &bodies };
        assert_eq!(cast.cell(&frame), ([-1.25, -0.25, -0.25], [3.25, 0.75, 0.25]));
        cast.bounds.min[0] = -2.0;
        cast.bounds.max[0] = 8.0;
        assert_eq!(cast.cell(&frame), ([-2.0, -0.25, -0.25], [8.0, 0.75, 0.25]));
        // Bodies that left for infinity are not drawn in.
        let bodies = [at(0.0, f64::INFINITY), at(0.0, f64::NAN)];
        let (low, high) = cast.cell(&Frame { number: 0, time: 0.0, bodies: &bodies });
        assert!((0..3).all(|k| low[k] < high[k] && low[k].is_finite() && high[k].is_finite()));
    }
}
