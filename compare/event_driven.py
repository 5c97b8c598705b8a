"""The same scenes on two event-driven simulators from PyPI: `billiards` (discs, elastic) and `pooltool` (pool).

Run by compare/run_event_driven, which makes the environment and Carom's half; prints Markdown.
Neither has a time step, so what is asked is not tunnelling or drift, but what an impact does, what happens where several
balls touch, and what an impact costs.
"""
import json
import math
import subprocess
import sys
import time

CAROM = sys.argv[1]
RADIUS = 0.5
SPEED = 3.0


def carom(scene):
    """Runs a scene (a dict) with the command line; its JSON."""
    done = subprocess.run([CAROM, "run", "-", "--format", "json"], input=json.dumps(scene), capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


def scene(balls, until, boundary=None):
    world = {"dim": 2}
    if boundary:
        world["boundary"] = boundary
    bodies = [{"mass": m, "radius": r, "position": list(x), "velocity": list(v)} for m, r, x, v in balls]
    return {"carom": 1, "world": world, "body": bodies, "run": {"until": until}}


def pairs():
    """Two balls, oblique: the impact parameter is half the sum of the radii."""
    for mass in (1.0, 3.0, 1000.0):
        along = math.sqrt(3.0) * RADIUS
        balls = [(1.0, RADIUS, (-along - 1.0, -RADIUS), (SPEED, 0.0)), (mass, RADIUS, (0.0, 0.0), (0.0, 0.0))]
        n = (math.sqrt(3.0) / 2.0, 0.5)
        j = 2.0 * SPEED * n[0] * mass / (1.0 + mass)
        exact = [(SPEED - j * n[0], -j * n[1]), (j / mass * n[0], j / mass * n[1])]
        yield balls, exact


def cradle(coming):
    balls = []
    for k in range(5):
        moves = k < coming
        balls.append((1.0, RADIUS, (2.0 * RADIUS * k - (1.0 if moves else 0.0), 0.0), (SPEED if moves else 0.0, 0.0)))
    return balls


def rack():
    balls = [(1.0, RADIUS, (-2.0 * RADIUS - 1.0, 0.0), (SPEED, 0.0))]
    mirror = [0]
    for n in range(5):
        first = len(balls)
        for k in range(n + 1):
            balls.append((1.0, RADIUS, (math.sqrt(3.0) * RADIUS * n, (2 * k - n) * RADIUS), (0.0, 0.0)))
            mirror.append(first + n - k)
    return balls, mirror


def asymmetry(velocities, mirror):
    return max(math.hypot(v[0] - velocities[m][0], v[1] + velocities[m][1]) for v, m in zip(velocities, mirror)) / SPEED


def energy(balls, velocities):
    return sum(0.5 * b[0] * (v[0] ** 2 + v[1] ** 2) for b, v in zip(balls, velocities))


def gas(count, speed=1.0, fraction=0.3, radius=0.1):
    side = math.sqrt(count * math.pi * radius**2 / fraction)
    edge = math.ceil(math.sqrt(count))
    pitch, state, balls = side / edge, 0x9E3779B97F4A7C15, []
    for k in range(count):
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        angle = 2.0 * math.pi * (state >> 11) / 2**53
        at = ((k % edge + 0.5) * pitch, (k // edge + 0.5) * pitch)
        balls.append((1.0, radius, at, (speed * math.cos(angle), speed * math.sin(angle))))
    return balls, side


def with_billiards(balls, until, walls=None):
    import billiards

    table = billiards.Billiard(walls or [])
    for m, r, x, v in balls:
        table.add_ball(x, v, radius=r, mass=m)
    start = time.process_time()
    events = table.evolve(until)
    return [tuple(v) for v in table.balls_velocity], len(events), time.process_time() - start


def with_carom(balls, until, boundary=None):
    told = carom(scene(balls, {"time": until}, boundary))
    return [b["velocity"] for b in told["bodies"]], told["impacts"]


def elastic():
    """pooltool's engine with its frictionless elastic balls, in place of the real ones of later versions; None where these
    are the only ones."""
    import pooltool.physics as physics
    from pooltool.physics.resolve.ball_ball.frictionless_elastic import FrictionlessElastic

    engine = physics.PhysicsEngine()
    engine.resolver.ball_ball = FrictionlessElastic()
    return engine


def with_pooltool(balls):
    """The impact of ball 0 with whatever it meets first, on a table of pool: the velocities right after the last ball-ball
    event at that instant. Balls must be alike, and are scaled to pooltool's."""
    import numpy as np
    import pooltool as pt

    params = pt.BallParams.default() if hasattr(pt.BallParams, "default") else pt.BallParams()
    scale = params.R / RADIUS
    table = pt.Table.default()
    # The whole scene is turned by half a radian: along an axis pooltool 0.3 divides by zero.
    c, s = math.cos(0.5), math.sin(0.5)
    made = {}
    for k, (_, _, x, v) in enumerate(balls):
        at = (c * x[0] - s * x[1], s * x[0] + c * x[1])
        ball = pt.Ball.create(f"b{k}", xy=(table.w / 2.0 + scale * at[0], table.l / 2.0 + scale * at[1]))
        ball.state.rvw[1] = np.array([c * v[0] - s * v[1], s * v[0] + c * v[1], 0.0])
        if v[0] or v[1]:
            ball.state.s = pt.constants.sliding
        made[ball.id] = ball
    cue = pt.Cue.default()
    cue.set_state(cue_ball_id="b0")
    system = pt.System(table=table, balls=made, cue=cue)
    start = time.process_time()
    # pooltool sets balls that touch a hair apart, so that what follows within a millisecond belongs to the impact.
    pt.simulate(system, engine=elastic(), inplace=True, t_final=1.0)
    spent = time.process_time() - start
    hits = [e for e in system.events if e.event_type == pt.EventType.BALL_BALL]
    if not hits:
        return None
    last = {}
    first = hits[0].time
    for event in hits:
        if event.time - first > 1e-3:
            break
        for agent in event.agents:
            last[agent.id] = agent.final.state.rvw[1] if hasattr(agent.final, "state") else agent.final.rvw[1]
    before = {a.id: (a.initial.state.rvw[1] if hasattr(a.initial, "state") else a.initial.rvw[1]) for a in hits[0].agents}
    arrival = float(np.linalg.norm(before["b0"]))
    n = sum(1 for e in hits if e.time - first <= 1e-3)
    back = [last.get(f"b{k}", np.zeros(3)) for k in range(len(balls))]
    return [(float(c * v[0] + s * v[1]), float(c * v[1] - s * v[0])) for v in back], arrival, n, len(system.events), spent


def show(numbers):
    return " ".join("0" if abs(x) < 5e-4 else f"{x:.3f}".rstrip("0").rstrip(".") for x in numbers)


def main():
    try:
        import pooltool as pt

        pool = pt.__version__
    except Exception as error:  # it wants a display library at import: say so, and go on
        pool, why = None, f"{type(error).__name__}: {error}"
    from importlib.metadata import version

    print(f"billiards {version('billiards')}, pooltool {pool or 'not run (' + why + ')'}, Python {sys.version.split()[0]}\n")

    print("## Two balls, oblique\n\nError of the velocities over the approach speed, worst of the masses 1:1, 1:3, 1:1000 (pooltool: 1:1).\n")
    worst = {"carom": 0.0, "billiards": 0.0}
    for balls, exact in pairs():
        for name, after in (("carom", with_carom(balls, 2.0)[0]), ("billiards", with_billiards(balls, 2.0)[0])):
            worst[name] = max([worst[name]] + [math.dist(a, b) / SPEED for a, b in zip(after, exact)])
    print("| Carom | billiards | pooltool |\n|---|---|---|")
    cell = "not run"
    if pool:
        balls, _ = next(iter(pairs()))
        after, arrival, *_ = with_pooltool(balls)
        n = (math.sqrt(3.0) / 2.0, 0.5)
        v = (arrival, 0.0)
        j = v[0] * n[0]
        exact = [(v[0] - j * n[0], -j * n[1]), (j * n[0], j * n[1])]
        cell = f"{max(math.dist(a, b) / arrival for a, b in zip(after, exact)):.0e}"
    print(f"| {worst['carom']:.0e} | {worst['billiards']:.0e} | {cell} |\n")

    print("## Newton's cradle\n\nVelocities after, over the speed of those that come in.\n")
    print("| | Carom | billiards | pooltool |\n|---|---|---|---|")
    for coming in (1, 2):
        balls = cradle(coming)
        row = [show([v[0] / SPEED for v in with_carom(balls, 2.0)[0]])]
        row.append(show([v[0] / SPEED for v in with_billiards(balls, 2.0)[0]]))
        if pool and coming == 1:
            told = with_pooltool(balls)
            row.append(show([v[0] / told[1] for v in told[0]]) if told else "no impact")
        else:
            row.append("—")
        print(f"| {'one' if coming == 1 else 'two'} in | " + " | ".join(row) + " |")

    print("\n## A rack of fifteen\n\nEnergy kept, and by how much the break differs from its mirror image over the cue ball's speed.\n")
    print("| | Carom | billiards | pooltool |\n|---|---|---|---|")
    balls, mirror = rack()
    whole = 0.5 * SPEED**2
    rows = [[], []]
    for after in (with_carom(balls, 2.0)[0], with_billiards(balls, 2.0)[0]):
        rows[0].append(f"{energy(balls, after) / whole:.4f}")
        rows[1].append(f"{100 * asymmetry(after, mirror):.2g} %")
    if pool:
        told = with_pooltool(balls)
        after, arrival = told[0], told[1]
        rows[0].append(f"{energy(balls, after) / (0.5 * arrival**2):.4f}")
        scaled = [(v[0] * SPEED / arrival, v[1] * SPEED / arrival) for v in after]
        rows[1].append(f"{100 * asymmetry(scaled, mirror):.2g} %")
    else:
        rows[0].append("not run")
        rows[1].append("not run")
    for name, row in zip(("energy", "asymmetry"), rows):
        print(f"| {name} | " + " | ".join(row) + " |")

    print("\n## A gas in a box\n\n500 discs at area fraction 0.3, elastic, 5 s: impacts, and what an impact costs (CPU time).\n")
    import billiards

    balls, side = gas(500)
    corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
    walls = [billiards.InfiniteWall(corners[k], corners[(k + 1) % 4]) for k in range(4)]
    after, events, spent = with_billiards(balls, 5.0, walls)
    box = {"kind": "box", "min": [0.0, 0.0], "max": [side, side]}
    bench = json.loads(subprocess.run([CAROM, "bench", "--name", "discs-0.30", "--n", "500", "--format", "json"], capture_output=True, text=True).stdout)[0]
    moved, impacts = with_carom(balls, 5.0, box)
    print("| | Carom | billiards |\n|---|---|---|")
    print(f"| impacts | {impacts} | {events} |")
    print(f"| energy, of 1 | 1 {energy(balls, moved) / 250.0 - 1.0:+.0e} | 1 {energy(balls, after) / 250.0 - 1.0:+.0e} |")
    print(f"| µs an impact | {bench['ns_per_impact'] / 1e3:.2f} (`carom bench --name discs-0.30 --n 500`) | {1e6 * spent / events:.0f} |")


main()
