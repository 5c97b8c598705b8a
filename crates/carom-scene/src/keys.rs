//! Every key of a scene file, once: the reader checks by this table, the nearest known key comes from it, `--set` and sweeps
//! find their way through it, and the JSON Schema is printed from it.

/// The rule a number keeps. Every number is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rule {
    Finite,
    Positive,
    NotNegative,
    Within(f64, f64),
}

/// What a key holds.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    Number(Rule),
    /// A number, or `{ curve = [[speed, value], ...] }`.
    Coefficient(Rule),
    Integer {
        least: u64,
        most: u64,
    },
    Text,
    Flag,
    Choice(&'static [&'static str]),
    /// dim numbers.
    Vector,
    /// 0, 1 or 3 numbers.
    Spin,
    /// Names of axes.
    Axes,
    /// Names of two materials.
    TwoNames,
    Table(&'static Shape),
    /// `[[name]]`
    List(&'static Shape),
    /// `[name.anything]`
    Named(&'static Shape),
    /// Dotted paths, each with its values.
    Sweep,
}

/// One key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    pub name: &'static str,
    pub kind: Kind,
    pub required: bool,
    /// What it says, with its unit and its default.
    pub about: &'static str,
}

/// The keys of one table.
#[derive(Debug)]
pub(crate) struct Shape {
    /// What one of it is called in a message: "a body".
    pub name: &'static str,
    pub about: &'static str,
    pub keys: &'static [Key],
}

impl Shape {
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|k| k.name == name)
    }

    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.keys.iter().map(|k| k.name)
    }
}

const fn key(name: &'static str, kind: Kind, about: &'static str) -> Key {
    Key { name, kind, required: false, about }
}

const fn required(name: &'static str, kind: Kind, about: &'static str) -> Key {
    Key { name, kind, required: true, about }
}

use Kind::*;
use Rule::*;

/// The most bodies a scene may have: room for the largest run, and no room for a typing error that fills the memory.
pub(crate) const MOST_BODIES: u64 = 20_000_000;
/// The largest integer that a number of any language holds exactly.
const EXACT: u64 = 9_007_199_254_740_992;

const FRACTION: Rule = Within(0.0, 1.0);

const MASS: Key = key("mass", Number(Positive), "Mass (kg). Or give density. A fixed body may do without.");
const DENSITY: Key = key(
    "density",
    Number(Positive),
    "Mass per length in 1D (kg/m), per area in 2D (kg/m^2), per volume in 3D (kg/m^3), instead of mass.",
);
const FIXED: Key = key(
    "fixed",
    Flag,
    "true: nothing moves this body, and its mass may be left out; with a velocity it is driven, untouched by gravity. \
     Default false.",
);
const RADIUS: Key = required("radius", Number(Positive), "Radius (m); half the length in 1D.");
const VELOCITY: Key = key("velocity", Vector, "Velocity (m/s), dim numbers. Default zeros.");
const SPIN: Key = key(
    "spin",
    Spin,
    "Angular velocity (rad/s): [] in 1D, [w] in 2D (counter-clockwise), [x, y, z] in 3D (right hand). Default zeros.",
);
const MATERIAL: Key = key("material", Text, "The name of a material. Default \"default\".");
const INERTIA: Key = key(
    "inertia",
    Number(Positive),
    "kappa in I = kappa m R^2. Default 1/2 in 2D (a disc), 2/5 in 3D (a sphere); 1D has none.",
);
const NAME: Key = key("name", Text, "A name that no other one has. Default: the kind and its number, \"body-1\".");

const RESTITUTION: Key = key(
    "restitution",
    Coefficient(FRACTION),
    "e in [0, 1]: departure speed over approach speed; a number, or a curve of the approach speed. Unsaid: the other \
     surface decides, and where neither says, 1.",
);
const FRICTION: Key = key(
    "friction",
    Coefficient(NotNegative),
    "Coulomb's mu >= 0: a number, or a curve of the slip speed. Unsaid: the other surface decides, and where neither says, 0.",
);
const TANGENTIAL: Key = key(
    "tangential",
    Number(Within(-1.0, 1.0)),
    "Tangential restitution e_t in [-1, 1]: 0 rolls, 1 is a superball; matters only with friction. Unsaid: the other \
     surface decides, and where neither says, 0.",
);

pub(crate) const LAWS: &[&str] = &["chatterjee-ruina", "stronge", "newton"];
const LAW_ABOUT: &str = "The law of one contact; they agree where there is no friction. Default \"chatterjee-ruina\".";

static BOUNDARY: Shape = Shape {
    name: "a boundary",
    about: "What lies around the world.",
    keys: &[
        required(
            "kind",
            Choice(&["open", "box", "periodic"]),
            "\"open\": nothing; \"box\": walls from min to max; \"periodic\": what leaves on one side enters on the other.",
        ),
        key("min", Vector, "The corner of the smallest coordinates (m), of \"box\" and \"periodic\"."),
        key("max", Vector, "The corner of the largest coordinates (m), of \"box\" and \"periodic\"."),
        key("material", Text, "The material of a box's walls. Default \"default\"."),
        key("periodic", Axes, "Axes of a box that go round instead of having walls, as in [\"x\"]. Default none."),
    ],
};

static WORLD: Shape = Shape {
    name: "the world",
    about: "Dimension, gravity and boundary.",
    keys: &[
        required("dim", Integer { least: 1, most: 3 }, "1, 2 or 3: the line, the plane, space."),
        key("gravity", Vector, "Acceleration of every body that is not fixed (m/s^2), dim numbers. Default zeros."),
        key("boundary", Table(&BOUNDARY), "Default open."),
    ],
};

static MATERIAL_TABLE: Shape = Shape {
    name: "a material",
    about: "What a surface says of an impact; every coefficient may be left unsaid.",
    keys: &[
        RESTITUTION,
        FRICTION,
        TANGENTIAL,
        key("rolling", Number(NotNegative), "Coefficient of rolling resistance of lasting contacts. Unsaid: 0."),
        key("spinning", Number(NotNegative), "Coefficient of spinning friction of lasting contacts. Unsaid: 0."),
    ],
};

static PAIR: Shape = Shape {
    name: "a pair",
    about: "What holds where two materials meet, whatever each of them says.",
    keys: &[
        required("materials", TwoNames, "The names of the two materials, in any order; they may be the same."),
        RESTITUTION,
        FRICTION,
        TANGENTIAL,
        key("law", Choice(LAWS), LAW_ABOUT),
    ],
};

static BODY: Shape = Shape {
    name: "a body",
    about: "A ball: the segment [x - r, x + r] in 1D, a disc in 2D, a sphere in 3D.",
    keys: &[
        NAME,
        MASS,
        DENSITY,
        FIXED,
        RADIUS,
        required("position", Vector, "Where its centre starts (m), dim numbers."),
        VELOCITY,
        SPIN,
        MATERIAL,
        INERTIA,
    ],
};

static GROUP_BODY: Shape = Shape {
    name: "the body of a group",
    about: "What every body of the group is; all keys of a body but name and position.",
    keys: &[MASS, DENSITY, FIXED, RADIUS, VELOCITY, SPIN, MATERIAL, INERTIA],
};

static PLANE: Shape = Shape {
    name: "a plane",
    about: "A half-space; balls live on the side the normal points to.",
    keys: &[
        required("point", Vector, "Any point of the plane (m), dim numbers."),
        required("normal", Vector, "Towards the balls; any length but 0."),
    ],
};

static SEGMENT: Shape = Shape {
    name: "a segment",
    about: "2D: a thin, two-sided piece of a line, with its end points.",
    keys: &[required("from", Vector, "One end (m)."), required("to", Vector, "The other end (m).")],
};

static ARC: Shape = Shape {
    name: "an arc",
    about: "2D: a thin, two-sided piece of a circle, counter-clockwise, with its end points.",
    keys: &[
        required("centre", Vector, "The centre of the circle (m)."),
        required("radius", Number(Positive), "The radius of the circle (m)."),
        required("from", Number(Finite), "Where it starts: degrees, counter-clockwise from +x."),
        required("to", Number(Finite), "Where it ends: degrees; at most one turn after from."),
    ],
};

static TRIANGLE: Shape = Shape {
    name: "a triangle",
    about: "3D: thin, two-sided, with its edges and corners.",
    keys: &[
        required("a", Vector, "The first corner (m)."),
        required("b", Vector, "The second corner (m)."),
        required("c", Vector, "The third corner (m)."),
    ],
};

static WALL: Shape = Shape {
    name: "a wall",
    about: "What no ball can move: exactly one of plane, segment, arc, triangle.",
    keys: &[
        NAME,
        key("plane", Table(&PLANE), "A half-space, in any dimension."),
        key("segment", Table(&SEGMENT), "A segment, in 2D."),
        key("arc", Table(&ARC), "An arc, in 2D."),
        key("triangle", Table(&TRIANGLE), "A triangle, in 3D."),
        key("velocity", Vector, "Velocity of a driven wall (m/s), a piston. Default zeros."),
        MATERIAL,
    ],
};

static DISTRIBUTION: Shape = Shape {
    name: "a distribution",
    about: "The velocities of a group.",
    keys: &[
        required(
            "distribution",
            Choice(&["maxwell", "fixed", "uniform"]),
            "\"maxwell\": a temperature; \"fixed\": all the same value; \"uniform\": all the same speed, in directions that \
             are spread evenly.",
        ),
        key("temperature", Number(NotNegative), "maxwell: <m v^2> / dim (J), exact by rescaling."),
        key("zero_momentum", Flag, "maxwell: whether the momenta add to zero. Default true (of one body: false)."),
        key("value", Vector, "fixed: the velocity (m/s)."),
        key("speed", Number(NotNegative), "uniform: the speed (m/s)."),
    ],
};

static GROUP: Shape = Shape {
    name: "a group",
    about: "Many equal bodies: gas-1, gas-2, ...",
    keys: &[
        key("name", Text, "The bodies are called name-1, name-2, ... Default \"group-1\", ..."),
        required(
            "kind",
            Choice(&["random", "square", "hexagonal", "fcc", "line", "rack"]),
            "How they are placed: \"random\", \"square\" (cubic in 3D), \"hexagonal\" (2D), \"fcc\" (3D), \"line\", \"rack\" \
             (2D, the triangle of billiards).",
        ),
        key(
            "count",
            Integer { least: 1, most: MOST_BODIES },
            "How many; not with \"rack\". A lattice without it fills its region.",
        ),
        key("min", Vector, "The region's corner of the smallest coordinates (m). Default: the boundary's."),
        key("max", Vector, "The region's corner of the largest coordinates (m). Default: the boundary's."),
        key("spacing", Number(NotNegative), "Gap between neighbours (m): pitch = 2 r + spacing. Default 0, touching."),
        key("origin", Vector, "Centre of the first body (m): lattice corner, line start, rack apex. Default min + r."),
        key("direction", Vector, "Where line and rack grow to; any length but 0. Default +x."),
        key("rows", Integer { least: 1, most: 6000 }, "Rows of a rack: n rows hold n (n + 1) / 2 bodies. Default 5."),
        required("body", Table(&GROUP_BODY), "What each of them is."),
        key("velocity", Table(&DISTRIBUTION), "Default: body.velocity."),
    ],
};

static UNTIL: Shape = Shape {
    name: "until",
    about: "What ends the run: the first that holds.",
    keys: &[
        key("time", Number(NotNegative), "This time (s)."),
        key("impacts", Integer { least: 0, most: EXACT }, "This many impacts; an instant is never split."),
        key("rest", Flag, "true: every body rests or is fixed. Default false."),
    ],
};

static RUN: Shape = Shape {
    name: "the run",
    about: "When it ends, and by which rules.",
    keys: &[
        key(
            "until",
            Table(&UNTIL),
            "Any of time, impacts, rest. It needs time or impacts, except in an open world without gravity and walls.",
        ),
        key("seed", Integer { least: 0, most: u64::MAX }, "Where the random numbers of groups start. Default 1."),
        key(
            "together",
            Choice(&["reflect", "sequential", "lcp"]),
            "Contacts at one instant: \"reflect\" (GR-e), \"sequential\", \"lcp\". Default \"reflect\".",
        ),
        key("law", Choice(LAWS), LAW_ABOUT),
        key(
            "rest_speed",
            Number(NotNegative),
            "Slower approaches (m/s) are plastic where gravity presses a contact together; 0 turns rest off. Default 0.01.",
        ),
    ],
};

static EVERY: Shape = Shape {
    name: "every",
    about: "How often to write.",
    keys: &[key("time", Number(Positive), "The time between two frames or samples (s).")],
};

static OUTPUT: Shape = Shape {
    name: "an output",
    about: "A file to write, by its extension.",
    keys: &[
        required("path", Text, "The file; its extension picks the format."),
        key(
            "every",
            Table(&EVERY),
            "Default: stills at the end, movies 25 frames a second, trajectories 60 samples over the run.",
        ),
    ],
};

/// The whole file.
pub(crate) static SCENE: Shape = Shape {
    name: "a scene",
    about: "A scene of carom: bodies that meet, and part with the right velocities. SI units; vectors are lists of dim numbers.",
    keys: &[
        required("carom", Integer { least: 1, most: 1 }, "Version of the format: 1."),
        key("title", Text, "What the scene is called. Default empty."),
        required("world", Table(&WORLD), "Dimension, gravity and boundary."),
        key("material", Named(&MATERIAL_TABLE), "Materials by name; \"default\" is that of whatever names none."),
        key("pair", List(&PAIR), "The pair table."),
        key("body", List(&BODY), "Bodies."),
        key("wall", List(&WALL), "Walls."),
        key("group", List(&GROUP), "Groups of bodies."),
        key("run", Table(&RUN), "When it ends, and by which rules."),
        key("output", List(&OUTPUT), "What to write; the same as -o on the command line."),
        key("sweep", Sweep, "Read only by a sweep: dotted paths, each with a list, or { range = [a, b] }, steps = n."),
    ],
};
