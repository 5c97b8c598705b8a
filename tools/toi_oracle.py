#!/usr/bin/env python3
"""Times of impact, found by brute force with 60 digits: writes crates/carom/tests/data/toi.json.

    pip install mpmath
    python3 tools/toi_oracle.py

The method shares nothing with the engine's: the distance between the centre and the whole obstacle is computed from the
nearest point, sampled densely along the path (in doubles), the turning points of the gap are bracketed and bisected (with 60
digits), and so is the first passage through zero on a falling piece. The rule is that of the engine: the event is the
first t >= 0 with gap <= 0 and falling gap.

A case is left out if it cannot be answered from doubles: a gap that turns, or a motion that starts, within 64 roundings
(of the largest length on the way) of the very boundary between a contact and none.
"""
import json
import math
import os
import random

from mpmath import mp, mpf

mp.dps = 60
EPS = 2.0**-52
MARGIN = 64 * EPS


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def sub(a, b):
    return [p - q for p, q in zip(a, b)]


def along(a, b, s):
    return [p + (q - p) * s for p, q in zip(a, b)]


def norm(a):
    square = dot(a, a)
    return mp.sqrt(square) if isinstance(square, mpf) else math.sqrt(square)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


# ---- the nearest point of each obstacle; numbers are either all doubles or all mpf ----

def on_point(p, shape):
    return [0 * c for c in p]


def on_segment(p, shape):
    a, b = shape
    e = sub(b, a)
    s = dot(sub(p, a), e) / dot(e, e)
    return along(a, b, min(max(s, 0 * s), 0 * s + 1))


def on_arc(p, shape):
    centre, radius, start, end = shape
    q = sub(p, centre)
    m = mp if isinstance(p[0], mpf) else math
    angle = m.atan2(q[1], q[0])
    turn = 2 * m.pi
    # The same direction, counted on from the start of the arc.
    past = (angle - start) - turn * m.floor((angle - start) / turn)
    if past > end - start and end - start < turn:
        angle = start if past - (end - start) > turn - past else end
    return [centre[0] + radius * m.cos(angle), centre[1] + radius * m.sin(angle)]


def on_triangle(p, shape):
    a, b, c = shape
    n = cross(sub(b, a), sub(c, a))
    if all(dot(cross(sub(v, u), sub(p, u)), n) >= 0 for u, v in ((a, b), (b, c), (c, a))):
        s = dot(sub(p, a), n) / dot(n, n)
        return [q - s * k for q, k in zip(p, n)]
    candidates = [on_segment(p, pair) for pair in ((a, b), (b, c), (c, a))]
    return min(candidates, key=lambda w: dot(sub(p, w), sub(p, w)))


def exactly(x):
    return [exactly(y) for y in x] if isinstance(x, (list, tuple)) else mpf(x)


class Motion:
    """The gap and its rate along a path."""

    def __init__(self, nearest, x, v, a, shape, r):
        self.nearest, self.x, self.v, self.a, self.shape, self.r = nearest, x, v, a, shape, r

    def at(self, t):
        return [x + t * (v + t * a / 2) for x, v, a in zip(self.x, self.v, self.a)]

    def both(self, t):
        p = self.at(t)
        w = [v + t * a for v, a in zip(self.v, self.a)]
        away = sub(p, self.nearest(p, self.shape))
        distance = norm(away)
        return distance - self.r, (dot(away, w) / distance if distance > 0 else distance)

    def gap(self, t):
        return self.both(t)[0]

    def rate(self, t):
        return self.both(t)[1]

    def rate_and_noise(self, t):
        """The rate, and a generous bound of what rounding may do to it."""
        gap, rate = self.both(t)
        length = sum(abs(x) + t * (abs(v) + t * abs(a)) for x, v, a in zip(self.x, self.v, self.a))
        speed = sum(abs(v) + t * abs(a) for v, a in zip(self.v, self.a))
        return rate, 1e3 * EPS * speed * (1 + length / (abs(gap + self.r) + 1e-300))


class Coordinate(Motion):
    """A coordinate over a plane: the gap may be negative by any depth."""

    def both(self, t):
        return self.at(t)[0] - self.r, self.v[0] + t * self.a[0]


def bisect(f, low, high):
    negative = f(low) < 0
    for _ in range(400):
        middle = (low + high) / 2
        if high - low <= mpf(10) ** -34 * high or middle in (low, high):
            break
        if (f(middle) < 0) == negative:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def around(t, horizon):
    """Samples that are the denser the closer to t."""
    return [t + sign * horizon * 10 ** (-j / 8) for sign in (1, -1) for j in range(120)]


def samples(motion, horizon, anchor):
    """Dense everywhere, denser at the start and wherever the path comes close to the obstacle."""
    times = [horizon * k / 400 for k in range(401)] + [horizon * 10 ** (-k / 4) for k in range(80)]

    def distance(t):
        return norm(sub(motion.at(t), anchor))

    grid = times[:401]
    far = [distance(t) for t in grid]
    for k in range(401):
        if (k == 0 or far[k] <= far[k - 1]) and (k == 400 or far[k] <= far[k + 1]):
            low, high = grid[max(k - 1, 0)], grid[min(k + 1, 400)]
            for _ in range(80):
                third = (high - low) / 3
                if distance(low + third) < distance(high - third):
                    high -= third
                else:
                    low += third
            times += around(low, horizon)
    return times


def slowest(motion, times, horizon):
    """Where the magnitude of the rate is smallest, locally: the four smallest of them."""
    times = sorted(t for t in set(times) if 0 <= t <= horizon)
    rates = [abs(motion.rate(t)) for t in times]
    found = []
    for k in range(1, len(times) - 1):
        if rates[k] <= rates[k - 1] and rates[k] <= rates[k + 1] and times[k + 1] - times[k - 1] > 1e-9 * times[k]:
            low, high = times[k - 1], times[k + 1]
            for _ in range(60):
                third = (high - low) / 3
                if abs(motion.rate(low + third)) < abs(motion.rate(high - third)):
                    high -= third
                else:
                    low += third
            found.append((abs(motion.rate(low)), low))
    return [t for _, t in sorted(found)[:3]]


def turning_points(rough, exact, times, horizon):
    """Where the rate changes its sign: bracketed by samples, in doubles where these can tell, and bisected, exactly."""
    times = sorted(t for t in set(times) if 0 <= t <= horizon)
    signs = []
    for t in times:
        rate, noise = rough.rate_and_noise(t)
        signs.append(rate < 0 if abs(rate) > noise else exact.rate(mpf(t)) < 0)
    turns = []
    for k in range(1, len(times)):
        if signs[k] != signs[k - 1]:
            s, t = mpf(times[k - 1]), mpf(times[k])
            if (exact.rate(s) < 0) != (exact.rate(t) < 0):
                turns.append(bisect(exact.rate, s, t))
    return sorted(turns)


def event(kind, nearest, x, v, a, shape, r, anchor, extent):
    """(time or None, closing speed, curvature, 'now' | 'root' | 'turn' | 'kink' |
    'never'), or None if it is too close to call."""
    rough = kind(nearest, x, v, a, shape, r)
    exact = kind(nearest, exactly(x), exactly(v), exactly(a), exactly(shape), exactly(r))
    speed, pull = norm(v), norm(a)
    need = norm(x) + norm(anchor) + extent + r
    if pull > 0:
        horizon = 1.2 * (speed + math.sqrt(speed * speed + 2 * pull * need)) / pull
    elif speed > 0:
        horizon = 1.2 * need / speed
    else:
        return (None, 0, 0, "never")
    times = samples(rough, horizon, anchor)
    turns = turning_points(rough, exact, times, horizon)
    for _ in range(3):
        # Close to one turn there may be more, and where the rate is small, as where the path grazes a seam.
        centres = [float(turn) for turn in turns] + slowest(rough, times, horizon)
        times += [t for centre in centres for t in around(centre, horizon)]
        before, turns = len(turns), turning_points(rough, exact, times, horizon)
        if len(turns) == before:
            break
    bounds = [mpf(0)] + turns + [mpf(horizon)]

    def rounding(t):
        return float(MARGIN * (need + speed * float(t) + pull * float(t) ** 2 / 2))

    start_gap, start_rate = exact.both(mpf(0))
    if start_gap < rounding(0) and 0 < abs(start_rate) < MARGIN * speed * (1 + need / r if r else 1):
        return None
    for start, end in zip(bounds, bounds[1:]):
        if end <= start:
            continue
        if not exact.rate((start + end) / 2) < 0:
            continue
        before, after = exact.gap(start), exact.gap(end)
        if abs(after) < rounding(end) and not before <= 0:
            return None  # grazing
        if 0 < start and abs(before) < rounding(start):
            return None  # a turning point that just touches
        if after >= 0:
            continue
        t = start if before <= 0 else bisect(exact.gap, start, end)
        h = mpf(10) ** -20 * (t + 1)
        curvature = abs(exact.rate(t + h) - exact.rate(max(t - h, mpf(0)))) / h / 2
        name = ("turn" if t > 0 else "now") if before <= 0 else "root"
        if name == "turn" and curvature > 1e12:
            name = "kink"  # another part of the obstacle became the nearest: the rate jumps
        return (float(t), float(-exact.rate(t)), float(curvature), name)
    return (None, 0, 0, "never")


# ---- the cases ----

random.seed(20141)


def short(x):
    return [short(y) for y in x] if isinstance(x, (list, tuple)) else float(f"{x:.5g}")


def direction(d):
    while True:
        n = [random.gauss(0, 1) for _ in range(d)]
        if norm(n) > 0.1:
            return [c / norm(n) for c in n]


def away_from(n, outward):
    """The direction, turned to the outer side."""
    return n if dot(n, outward) > 0 else [-c for c in n]


def tangent(n):
    while True:
        w = direction(len(n))
        w = [p - dot(w, n) * q for p, q in zip(w, n)]
        if norm(w) > 0.1:
            return [c / norm(w) for c in w]


def pull(d):
    return random.choice([[0.0] * d, [0.0] * (d - 1) + [-9.81], short([random.uniform(-3, 3) for _ in range(d)])])


STYLES = ["random", "aimed", "aimed", "graze", "far", "near", "overlap", "impact", "sink"]


def motion_to(style, place, d, r, size, accelerated):
    """A path towards (or from) a place on the obstacle: (point, outward normal there)."""
    a = pull(d) if accelerated else [0.0] * d
    if style == "random":
        return short([random.uniform(-3, 3) * (size + r) for _ in range(d)]), short([random.gauss(0, 4) for _ in range(d)]), a
    point, n = place()
    w = [c * random.choice([1, 1, 10]) for c in short([random.gauss(0, 2) for _ in range(d)])]
    closing = dot(w, n)
    if style in ("aimed", "far") and closing > 0 or style == "impact" and closing < 0:
        w = [p - 2 * closing * q for p, q in zip(w, n)]
    t = random.uniform(0.1, 3)
    reach = r
    if style == "graze":
        speed = random.uniform(0.5, 5)
        w = [speed * c for c in tangent(n)] if d > 1 else w
        reach = r * (1 + random.choice([-1, 1]) * 10 ** -random.uniform(8, 14))
        t = random.uniform(0.5, 8) * (size + r) / norm(w)
    elif style == "far":
        t = 10 ** random.uniform(5, 7) * r / norm(w)
        a = [0.0] * d if random.random() < 0.5 else [c * 1e-3 / t for c in a]
    elif style == "near":
        t, reach = 0, r * (1 + random.choice([1e-12, 1e-9, 1e-14]))
    elif style == "overlap":
        t, reach = 0, r * (1 - 10 ** -random.uniform(0.5, 16))
    elif style == "impact":
        t = 0
    elif style == "sink":
        # Overlapping, parting slowly, and pulled back in.
        t, depth, g = 0, 10 ** -random.uniform(0.5, 8), random.uniform(1, 10)
        reach = r * (1 - depth)
        a = [-g * c for c in n] if accelerated else a
        slow = 0.3 * math.sqrt(g * r) * random.random()
        aside = tangent(n) if d > 1 else [0.0]
        w = [slow * p + random.uniform(0, 1.6) * math.sqrt(2 * g * depth * r) * q for p, q in zip(aside, n)]
    if t:
        w, a = short(w), (a if style != "far" else short(a))
    contact = [p + reach * q for p, q in zip(point, n)]
    v = [p - t * q for p, q in zip(w, a)]
    x = [c - t * (p + t * q / 2) for c, p, q in zip(contact, v, a)]
    return x, v, a


def ball_place(d):
    return lambda: ([0.0] * d, direction(d))


def segment_place(shape, d):
    a, b = shape
    e = sub(b, a)
    unit = [c / norm(e) for c in e]

    def place():
        which = random.choice(["side", "side", "seam", "end"])
        s = random.random() if which == "side" else random.choice([0.0, 1.0])
        n = tangent(unit) if which != "end" else away_from(direction(d), [c * (s - 0.5) for c in unit])
        return along(a, b, s), n

    return place


def arc_place(shape, r):
    centre, radius, start, end = shape

    def place():
        which = random.choice(["outside", "inside", "end", "seam"])
        angle = random.uniform(start, end) if which in ("outside", "inside") else random.choice([start, end])
        radial = [math.cos(angle), math.sin(angle)]
        if which == "end":
            outward = [radial[1], -radial[0]] if angle == start else [-radial[1], radial[0]]
            n = away_from(direction(2), outward)
        else:
            inside = which == "inside" or which == "seam" and random.random() < 0.5
            n = [-c for c in radial] if inside else radial
        return [centre[k] + radius * radial[k] for k in range(2)], n

    return place


def triangle_place(shape):
    n = cross(sub(shape[1], shape[0]), sub(shape[2], shape[0]))
    n = [c / norm(n) for c in n]
    middle = [sum(c) / 3 for c in zip(*shape)]

    def place():
        which = random.choice(["face", "face", "edge", "corner", "seam", "corner seam"])
        k = random.randrange(3)
        a, b = shape[k], shape[(k + 1) % 3]
        side = random.choice([1, -1])
        if which == "face":
            s, t = sorted([random.random(), random.random()])
            w = [s, t - s, 1 - t]
            return [sum(w[i] * shape[i][j] for i in range(3)) for j in range(3)], [side * c for c in n]
        if which == "corner seam":
            return a, [side * c for c in n]
        if which == "corner":
            return a, away_from(direction(3), sub(a, middle))
        point = along(a, b, random.random())
        out = cross(sub(b, a), n)
        out = [c / norm(out) for c in out]
        angle = random.uniform(-1, 1) * math.pi / 2 if which == "edge" else side * math.pi / 2
        return point, [math.cos(angle) * p + math.sin(angle) * q for p, q in zip(out, n)]

    return place


TABLES = {}


def keep(table, style, numbers, answer):
    if answer is None:
        return
    t, speed, curvature, name = answer
    row = [style, *numbers, name, t, float(f"{speed:.3g}"), float(f"{curvature:.3g}")]
    TABLES.setdefault(table, []).append(row)


def fill(table, count, make):
    tries = 0
    while len(TABLES.get(table, [])) < count and tries < 4 * count:
        make(STYLES[tries % len(STYLES)])
        tries += 1
    print(f"{table:>24} {len(TABLES[table]):5} cases of {tries}", flush=True)


def make_ball(table, accelerated):
    def make(style):
        d = random.choice([2, 3]) if random.random() < 0.9 else 1
        r = short(10 ** random.uniform(-1, 0.5))
        x, v, a = motion_to(style, ball_place(d), d, r, r, accelerated)
        answer = event(Motion, on_point, x, v, a, [], r, [0.0] * d, 0.0)
        keep(table, style, [x, v, a, [], r] if accelerated else [x, v, r], answer)
    return make


def make_plane(style):
    r = random.choice([0.0, short(random.uniform(0.1, 2))])
    size = 1 + r
    x, v, a = [short(size * random.uniform(0, 9))], [short(random.gauss(0, 4))], [random.choice([0.0, -9.81, 9.81, short(random.gauss(0, 3))])]
    if style == "graze":
        a = [abs(a[0]) + 1.0]
        v = [-math.sqrt(2 * a[0] * abs(x[0] - r)) * (1 + random.choice([-1, 1]) * 10 ** -random.uniform(8, 14))]
    elif style == "far":
        x = [x[0] * 10 ** random.uniform(5, 7)]
    elif style == "near":
        x = [r + size * 1e-12]
    elif style == "overlap":
        x = [r - size * 10 ** -random.uniform(0.5, 16)]
    elif style == "sink":
        depth = size * 10 ** -random.uniform(0.5, 8)
        x, a = [r - depth], [-9.81]
        v = [random.uniform(0, 1.6) * math.sqrt(2 * 9.81 * depth)]
    elif style == "impact":
        x = [r]
        v = [abs(v[0])]
    elif style == "aimed":
        a = [a[0] * 10 ** -random.uniform(0, 12)]
    answer = event(Coordinate, None, x, v, a, [], r, [0.0], 1.0)
    keep("plane", style, [x[0], v[0], a[0], r], answer)


def make_exit(style):
    low = short(random.uniform(-3, 0))
    high = low + random.choice([1.0, 0.25, 7.5])
    x, v, a = random.uniform(low, high), short(random.gauss(0, 2)), random.choice([0.0, -9.81, 9.81, short(random.gauss(0, 3))])
    if style in ("impact", "near"):
        x = random.choice([low, high])
    elif style == "overlap":
        x = random.choice([low - 1e-12, high + 1e-12, low - 1e-3, high + 1e-3])
    elif style == "far":
        x = short(x)
        low, high = -1e7, 1e6
    answers = [
        event(Coordinate, None, [y], [s * v], [s * a], [], 0.0, [0.0], 1.0)
        for s, y in ((1, mpf(x) - mpf(low)), (-1, mpf(high) - mpf(x)))
    ]
    if None in answers:
        return
    answer = min(answers, key=lambda answer: math.inf if answer[0] is None else answer[0])
    keep("exit", style, [x, v, a, low, high], answer)


def make_segment(table, d):
    def make(style):
        a = short([random.uniform(-2, 2) for _ in range(d)])
        e = [c * 10 ** random.uniform(-1, 1) for c in direction(d)]
        shape = [a, short([p + q for p, q in zip(a, e)])]
        length = norm(sub(*shape))
        r = short(length * 10 ** random.uniform(-1.5, 0.7))
        x, v, acc = motion_to(style, segment_place(shape, d), d, r, length, True)
        answer = event(Motion, on_segment, x, v, acc, shape, r, along(*shape, 0.5), length)
        keep(table, style, [x, v, acc, shape, r], answer)
    return make


def make_arc(style):
    centre = short([random.uniform(-2, 2) for _ in range(2)])
    radius = short(10 ** random.uniform(-0.5, 1))
    start = short(random.uniform(-4, 4))
    sweep = random.choice([math.pi, 2 * math.pi, 7.0, random.uniform(0.05, 3), random.uniform(3.2, 6.2)])
    shape = [centre, radius, start, start + sweep]
    r = short(radius * 10 ** random.uniform(-1.5, 0.4))
    x, v, acc = motion_to(style, arc_place(shape, r), 2, r, radius, True)
    if random.random() < 0.3:  # start inside
        x = short([c + random.uniform(-0.6, 0.6) * radius for c in centre])
    answer = event(Motion, on_arc, x, v, acc, shape, r, centre, 2 * radius)
    keep("arc", style, [x, v, acc, shape, r], answer)


def make_triangle(style):
    size = 10 ** random.uniform(-0.5, 1)
    shape = short([[random.uniform(-1, 1) * size for _ in range(3)] for _ in range(3)])
    if random.random() < 0.3:  # a slender one
        t = 10 ** -random.uniform(1, 3)
        shape[2] = short([p + t * (q - p) for p, q in zip(along(shape[0], shape[1], random.random()), shape[2])])
    r = short(size * 10 ** random.uniform(-1.5, 0.5))
    x, v, acc = motion_to(style, triangle_place(shape), 3, r, size, True)
    middle = [sum(c) / 3 for c in zip(*shape)]
    answer = event(Motion, on_triangle, x, v, acc, shape, r, middle, 2 * size)
    keep("triangle", style, [x, v, acc, shape, r], answer)


def main():
    fill("ball_ball", 400, make_ball("ball_ball", False))
    fill("ball_ball_accelerated", 400, make_ball("ball_ball_accelerated", True))
    fill("plane", 300, make_plane)
    fill("exit", 200, make_exit)
    fill("segment", 400, make_segment("segment", 2))
    fill("wire", 200, make_segment("wire", 3))
    fill("arc", 450, make_arc)
    fill("triangle", 350, make_triangle)
    path = os.path.join(os.path.dirname(__file__), "..", "crates", "carom", "tests", "data", "toi.json")
    with open(path, "w") as out:
        out.write("{\n")
        for i, (table, rows) in enumerate(TABLES.items()):
            lines = ",\n".join(json.dumps(row, separators=(",", ":"), default=float) for row in rows)
            out.write(f'"{table}":[\n{lines}\n]{"," if i < len(TABLES) - 1 else ""}\n')
        out.write("}\n")
    print(os.path.getsize(path), "bytes")


main()
