"""Reference solutions of hard cases that have no short closed form.

Judge of the suite of hard cases. Needs mpmath: python3 hard_cases_reference.py
Writes hard_cases_reference.csv beside itself, within a minute. Each line: case, quantity, value, with
20 digits, in SI units. The inputs are exact doubles, the same as in the scenes of the suite.

Linear cases are sums over the eigenvectors of their matrix, found with 100 digits; each solution is
checked to fulfil its equations at the times that are asked for. Cases with events are flights and
contacts in turn, whose roots are isolated by scanning and found with 50 digits.

Signs: x, velocities and forces are positive from the impactor towards the support.
"""

from pathlib import Path

from mpmath import cos, eig, exp, findroot, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 100
lines = []


def exact(value):
    """The double that a scene holds."""
    return mpf(float(value))


def give(case, **values):
    for quantity, value in values.items():
        shown = mpf(value) if abs(value) > mpf(10) ** -60 else mpf(0)
        lines.append(f"{case},{quantity},{nstr(shown, 20, min_fixed=1, max_fixed=0)}")


class Modes:
    """The solution of y' = A y, whose rates must differ."""

    def __init__(self, rows, start):
        self.matrix = matrix(rows)
        self.rates, self.shapes = eig(self.matrix)
        self.shares = lu_solve(self.shapes, matrix(start))

    def at(self, t):
        count = len(self.rates)
        parts = [self.shares[i] * exp(self.rates[i] * mpf(t)) for i in range(count)]
        value = [sum((self.shapes[j, i] * parts[i]).real for i in range(count)) for j in range(count)]
        slope = [
            sum((self.shapes[j, i] * parts[i] * self.rates[i]).real for i in range(count)) for j in range(count)
        ]
        residual = matrix(slope) - self.matrix * matrix(value)
        size = max(abs(part) for part in slope) or 1
        assert max(abs(part) for part in residual) <= mpf(10) ** -30 * size
        return value


def pad(mass, branches, spring=0):
    """A mass at x, v on a spring beside Maxwell branches (K, C), in the states x, v and their forces."""
    count = len(branches)
    rows = [[mpf(0)] * (count + 2) for _ in range(count + 2)]
    rows[0][1] = mpf(1)
    rows[1][0] = -exact(spring) / exact(mass)
    for at, (stiffness, damping) in enumerate(branches):
        rows[1][2 + at] = -1 / exact(mass)
        rows[2 + at][1] = exact(stiffness)
        rows[2 + at][2 + at] = -exact(stiffness) / exact(damping)
    return Modes(rows, [0, 1] + [0] * count)


def nearly_equal_times():
    for gap in ["1e-2", "1e-6", "1e-10", "1e-14"]:
        solution = pad(1, [(1, 1), (1, 1 + float(gap))], 0.5)
        x, v, *_ = solution.at(3)
        give(f"times-apart-{gap}", position=x, velocity=v)


def many_decades():
    solution = pad(1, [(1, float(f"1e{power}")) for power in range(-6, 7)])
    for t in ["1", "1e3", "1e6"]:
        x, v, *_ = solution.at(t)
        give(f"decades-{t}", position=x, velocity=v)


def stiff_pads():
    slow = [0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0]
    for fastest in ["1e-1", "1e-4", "1e-7", "1e-10"]:
        solution = pad(1, [(1, own) for own in [float(fastest), *slow]], 1)
        for t in ["1", "100"]:
            x, v, *_ = solution.at(t)
            give(f"pad-{fastest}-{t}", position=x, velocity=v)


def light_nodes():
    k1, k2, c2 = 1e4, 2e4, 100.0
    t = exact(0.05)
    for mass in ["1e-2", "1e-6", "1e-12", "1e-18", "0"]:
        m = exact(mass)
        if m == 0:
            rows = [[0, 1, 0], [-k1, 0, k1], [k1 / mpf(c2), 0, -(k1 + k2) / mpf(c2)]]
            solution = Modes(rows, [0, 1, 0])
        else:
            rows = [[0, 1, 0, 0], [-k1, 0, k1, 0], [0, 0, 0, 1], [k1 / m, 0, -(k1 + k2) / m, -c2 / m]]
            solution = Modes(rows, [0, 1, 0, 0])
        state = solution.at(t)
        give(f"light-node-{mass}", head=state[0], velocity=state[1], node=state[2], force=k1 * (state[0] - state[2]))


def stiff_joints():
    k, c = 1e3, 10.0
    t = exact(0.1)
    for stiffness in ["1e4", "1e8", "1e12", "1e16"]:
        joint = exact(stiffness)
        rows = [[0, 1, 0, 0], [-joint, 0, joint, 0], [0, 0, 0, 1], [joint / 2, 0, -(joint + k) / 2, -mpf(c) / 2]]
        state = Modes(rows, [0, 1, 0, 1]).at(t)
        give(f"stiff-joint-{stiffness}", first=state[0], second=state[2], velocity=state[3])


def first_root(function, start, step, end):
    """The first sign change after `start`, found to 50 digits."""
    t = mpf(start)
    sign = function(t + step / 100) > 0
    t += step / 100
    while t < end:
        if (function(t + step) > 0) != sign:
            return findroot(function, (t, t + step), solver="anderson", tol=mpf(10) ** -60)
        t += step
    return None


def damped_joints():
    """Three masses in a row, the first two joined by a strong dashpot, the second one light."""
    m, k, c = [exact(own) for own in (1.3, 0.0025, 3.1)], exact(1.01), exact(0.3861)
    joint = exact(79486.0)
    for damping in ["1e4", "1e8", "1e12", "1e16", "1e20"]:
        d = exact(damping)
        rows = [
            [0, 1, 0, 0, 0, 0],
            [-joint / m[0], -d / m[0], joint / m[0], d / m[0], 0, 0],
            [0, 0, 0, 1, 0, 0],
            [joint / m[1], d / m[1], -(joint + k) / m[1], -(d + c) / m[1], k / m[1], c / m[1]],
            [0, 0, 0, 0, 0, 1],
            [0, 0, k / m[2], c / m[2], -2 * k / m[2], -2 * c / m[2]],
        ]
        state = Modes(rows, [0, 1, 0, 1, 0, 0]).at(10)
        give(f"damped-joint-{damping}", first=state[0], velocity=state[1], third=state[4])


def second_hit():
    """A mass with weight on a Maxwell face from which it parts: the face stays where it was left."""
    mp.dps = 50
    mass, k, c, g, speed, end = exact(1), exact(1e4), exact(1000), exact(9.80665), exact(2), exact(0.6)
    t, x, v = mpf(0), mpf(0), speed
    half = k / (2 * c)
    omega = sqrt(k / mass - half**2)
    # F'' + (K/C) F' + (K/m) F = K g; F(0) = 0, F'(0) = K v.
    count = 0
    while True:
        rest = mass * g
        a, b = -rest, (k * v - half * rest) / omega
        force = lambda s: rest + exp(-half * s) * (a * cos(omega * s) + b * sin(omega * s))
        impulse = lambda s: rest * s + integral(half, omega, a, b, s)
        speed_at = lambda s, v=v: v + g * s - impulse(s) / mass
        # F' = K (v - F/C), so x' = v has the integral x = (F - F0)/K + impulse/C.
        place = lambda s, x=x: x + force(s) / k + impulse(s) / c
        release = first_root(force, 0, mpf("1e-4"), end - t)
        if release is None or t + release > end:
            raise AssertionError("no flight is under way at the end")
        count += 1
        t, x, v = t + release, place(release), speed_at(release)
        give("second-hit", **{f"release-{count}": t, f"speed-{count}": v, f"place-{count}": x})
        flight = -2 * v / g
        assert v < 0
        if t + flight > end:
            s = end - t
            give("second-hit", count=count, position=x + v * s + g * s**2 / 2, velocity=v + g * s)
            return
        t, v = t + flight, -v


def integral(half, omega, a, b, s):
    """∫ e^(-half t) (a cos + b sin)(omega t) from 0 to s."""
    size = half**2 + omega**2
    decay = exp(-half * s)
    cosine = (half + decay * (omega * sin(omega * s) - half * cos(omega * s))) / size
    sine = (omega - decay * (half * sin(omega * s) + omega * cos(omega * s))) / size
    return a * cosine + b * sine


def moving_support():
    """A ball with weight on ground that shakes, which gives back 80 % of the relative speed."""
    mp.dps = 50
    way, omega, e, g, end = exact(0.001), 2 * pi * 10, exact(0.8), exact(9.80665), exact(0.97)
    ground = lambda t: way * sin(omega * t)
    pace = lambda t: way * omega * cos(omega * t)
    t, x, v = mpf(0), mpf(0), exact(2)
    count = 0
    while True:
        v = pace(t) - e * (v - pace(t))
        count += 1
        gap = lambda s: ground(t + s) - (x + v * s + g * s**2 / 2)
        flight = first_root(gap, 0, mpf("1e-3"), 10)
        if t + flight > end:
            s = end - t
            give("moving-support", count=count, position=x + v * s + g * s**2 / 2, velocity=v + g * s)
            return
        x, v, t = x + v * flight + g * flight**2 / 2, v + g * flight, t + flight
        give("moving-support", **{f"touch-{count + 1}": t})


nearly_equal_times()
many_decades()
stiff_pads()
light_nodes()
stiff_joints()
damped_joints()
second_hit()
moving_support()
head = "# Reference solutions of hard cases. Regenerate: python3 hard_cases_reference.py (needs mpmath).\n"
head += "# Conventions and methods stand at the head of that script.\ncase,quantity,value\n"
Path(__file__).with_suffix(".csv").write_text(head + "\n".join(lines) + "\n")
