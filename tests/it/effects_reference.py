"""Reference solutions of the effects: separation, stops, faces with mass, friction, waves, nonlinear laws, chirps.

Judge of the tests on effects. Needs mpmath: python3 effects_reference.py
Writes effects_reference.csv beside itself, in about two minutes. Each line: case, quantity, value. Values
have 20 digits and are in SI units. Quantities that begin with "param." are the inputs, exact doubles;
the others are results. A time counts from the start of the case, and "-n" numbers the events of one
kind: touch-1 is the contact at the start, so the first return is touch-2. What is smaller than 1e-40 is
written as 0.

Signs: x, velocities and forces on bodies are positive from the impactor towards the support,
deformations are positive in compression, and the force of a pad is positive when it pushes.

Linear phases are solved by Taylor series of the matrix exponential, of which every extremum and every
root is isolated by bounds on derivatives; each phase is compared with mpmath's own exponential, each
case with closed forms where there are any, and with its balance of energy. Nonlinear cases are solved
by quadrature and compared with Gauss-Legendre integration of the equation of motion.
"""

from pathlib import Path

from mpmath import acos, acosh, asin, atan, atan2, beta, ceil, cos, ellipk, exp, expm, findroot, fresnelc, fresnels
from mpmath import gamma, lambertw
from mpmath import legendre, log, log1p, lu_solve, matrix, mp, mpc, mpf, nstr, pi, quad, sin, sqrt

mp.dps = 50
G0 = 9.80665
DEGREE = 42
lines = []


class Case:
    """Collects the lines of one case."""

    def __init__(self, name):
        self.name = name

    def param(self, name, value):
        self.give("param." + name, mpf(float(value)))
        return mpf(float(value))

    def params(self, **values):
        return [self.param(name, value) for name, value in values.items()]

    def give(self, quantity, value):
        shown = mpf(value) if abs(value) > mpf(10) ** -40 else mpf(0)
        lines.append(f"{self.name},{quantity},{nstr(shown, 20, min_fixed=1, max_fixed=0)}")


def agree(first, second, tolerance="1e-30", scale=None):
    """Fails unless two values agree relative to the larger one, or to `scale`."""
    size = max(abs(first), abs(second)) if scale is None else abs(scale)
    apart = abs(first - second)
    assert apart <= mpf(tolerance) * size, (nstr(first, 25), nstr(second, 25), nstr(apart, 3))


# Linear forms over named unknowns; "1" stands for the constant one.


class Form:
    def __init__(self, terms):
        self.terms = terms

    def __add__(self, other):
        terms = dict(self.terms)
        for name, factor in lift(other).terms.items():
            terms[name] = terms.get(name, mpf(0)) + factor
        return Form(terms)

    def __mul__(self, factor):
        return Form({name: own * factor for name, own in self.terms.items()})

    def __neg__(self):
        return self * -1

    def __sub__(self, other):
        return self + -lift(other)

    def __truediv__(self, factor):
        return Form({name: own / factor for name, own in self.terms.items()})

    def __rsub__(self, other):
        return lift(other) - self

    __radd__ = __add__
    __rmul__ = __mul__

    def of(self, state):
        return sum((factor * (1 if name == "1" else state[name]) for name, factor in self.terms.items()), mpf(0))


def lift(value):
    return value if isinstance(value, Form) else Form({"1": mpf(value)})


def unknowns(names):
    return [Form({name: mpf(1)}) for name in names.split()]


# Polynomials on [0, 1]: coefficients, lowest power first.


def value(p, s):
    total = mpf(0)
    for own in reversed(p):
        total = total * s + own
    return total


def slope(p):
    return [k * own for k, own in enumerate(p)][1:]


def polished(p, dp, low, high):
    """The root of p between two points at which its signs differ, where p is monotone."""
    falling = value(p, low) > 0
    s = (low + high) / 2
    for _ in range(400):
        here = value(p, s)
        if here == 0:
            return s
        if (here > 0) == falling:
            low = s
        else:
            high = s
        there = value(dp, s)
        following = s - here / there if there else low
        if not low < following < high:
            following = (low + high) / 2
        if abs(following - s) <= mpf(10) ** (4 - mp.dps) * abs(s) or high - low <= mpf(10) ** (2 - mp.dps) * high:
            return following
        s = following
    raise ArithmeticError("no root")


def roots(p):
    """All simple roots in (0, 1], in order; yields each when it is asked for. Close pairs are an error."""
    dp = slope(p)
    sizes = [abs(own) for own in p]
    first, second = slope(sizes), slope(slope(sizes))
    todo = [(mpf(0), mpf(1))]
    while todo:
        low, high = todo.pop()
        middle, radius = (low + high) / 2, (high - low) / 2
        if abs(value(p, middle)) > value(first, high) * radius:
            continue
        if abs(value(dp, middle)) > value(second, high) * radius:
            at_low, at_high = value(p, low), value(p, high)
            if at_low * at_high < 0 or (at_high == 0 and at_low != 0):
                yield polished(p, dp, low, high) if at_high else high
            continue
        if radius < mpf(10) ** -12:
            if low == 0:
                continue
            raise ArithmeticError("a root of higher order")
        todo += [(middle, high), (low, middle)]


# Phases: unknowns with linear rates, followed until the first guard would become negative.


class Mode:
    """`rates`: unknown to form. `guards`: name to form, positive while the mode lasts. `losses`: (C, rate) pairs."""

    def __init__(self, rates, guards=None, losses=()):
        self.names = list(rates)
        self.guards = guards or {}
        self.losses = losses
        column = {name: j for j, name in enumerate(self.names)}
        self.rows = [[(column[n], f) for n, f in own.terms.items() if n != "1" and f] for own in rates.values()]
        self.constants = [own.terms.get("1", mpf(0)) for own in rates.values()]
        size = len(self.names)
        A = matrix(size, size)
        for i, row in enumerate(self.rows):
            for j, factor in row:
                A[i, j] = factor
        power = A
        for _ in range(4):
            power = power * power
        largest = max(abs(own) for own in power)
        self.longest = 1 / largest ** (mpf(1) / 16) if largest else None

    def series(self, state, h):
        """Taylor coefficients of all unknowns, in units of the step."""
        now = [state[name] for name in self.names]
        terms = [now]
        for k in range(DEGREE):
            now = [sum((f * now[j] for j, f in row), mpf(0)) for row in self.rows]
            if k == 0:
                now = [own + constant for own, constant in zip(now, self.constants)]
            now = [own * h / (k + 1) for own in now]
            terms.append(now)
        return {name: [own[i] for own in terms] for i, name in enumerate(self.names)}

    def noise(self, form, state, h):
        """Largest sums of terms in the lowest derivatives of a form: what rounding is relative to."""
        now = [abs(state[name]) for name in self.names]
        sums = []
        for k in range(6):
            own = sum(abs(f) * now[self.names.index(n)] for n, f in form.terms.items() if n != "1")
            sums.append(own + (abs(form.terms.get("1", mpf(0))) if k == 0 else 0))
            now = [sum((abs(f) * now[j] for j, f in row), mpf(0)) for row in self.rows]
            if k == 0:
                now = [own + abs(constant) for own, constant in zip(now, self.constants)]
            now = [own * h / (k + 1) for own in now]
        return sums

    def exponential(self, state, duration):
        """The state after a time by mpmath's matrix exponential: the second method."""
        size = len(self.names)
        A = matrix(size + 1, size + 1)
        for i, row in enumerate(self.rows):
            for j, factor in row:
                A[i, j] = factor * duration
            A[i, size] = self.constants[i] * duration
        z = expm(A) * matrix([state[name] for name in self.names] + [1])
        return {name: z[i] for i, name in enumerate(self.names)}


def polynomial(form, series):
    p = [mpf(0)] * (DEGREE + 1)
    for name, factor in form.terms.items():
        if name == "1":
            p[0] += factor
        else:
            p = [own + factor * other for own, other in zip(p, series[name])]
    return p


class Arc:
    """One phase of a motion, from `start` to `end`; `event` is the name of the guard that ended it, or None."""

    def __init__(self, mode, state, start, horizon, verify=True):
        self.mode, self.start, self.state = mode, start, dict(state)
        self.pieces = []
        self.event = None
        time, fresh = start, True
        while self.event is None and time < horizon:
            h = horizon - time if mode.longest is None else min(horizon - time, mode.longest)
            series = mode.series(state, h)
            s = mpf(1)
            for name, guard in mode.guards.items():
                own = self.first_fall(mode, guard, series, state, h, fresh)
                if own is not None and (own < s or (own == s and self.event is None)):
                    s, self.event = own, name
            self.pieces.append((time, h, s, series))
            time += s * h
            state = {name: value(p, s) for name, p in series.items()}
            fresh = False
        self.end, self.final = time, state
        if verify and self.end > start:
            other = mode.exponential(self.state, self.end - start)
            for name in mode.names:
                ends = [abs(value(series[name], s)) for _, _, s, series in self.pieces]
                agree(state[name], other[name], "1e-33", max(ends + [abs(self.state[name]), mpf("1e-12")]))

    @staticmethod
    def first_fall(mode, guard, series, state, h, fresh):
        """Where in the step the guard falls below zero; at a fresh start by its first derivative that is not zero."""
        p = polynomial(guard, series)
        skipped = 0
        if fresh:
            for own in mode.noise(guard, state, h):
                if abs(p[0]) > mpf(10) ** (12 - mp.dps) * own:
                    break
                p, skipped = p[1:], skipped + 1
            if skipped == 6:
                return None
        if p[0] < 0:
            return mpf(0)
        return next(roots(p), None)

    def at(self, form, time):
        form = lift(form)
        start, h, s, series = [own for own in self.pieces if own[0] <= time][-1]
        return value(polynomial(form, series), (time - start) / h)

    def after_start(self, form):
        """Value at the beginning of the phase."""
        return lift(form).of(self.state)

    def largest(self, form):
        """Largest value and its time, ends included."""
        best = (form.of(self.state), self.start)
        for start, h, s, series in self.pieces:
            p = polynomial(form, series)
            rates = slope(p)
            still = max(map(abs, rates)) <= mpf(10) ** (12 - mp.dps) * abs(p[0])
            spots = [s] if still else [own for own in roots(rates) if own < s] + [s]
            best = max([best] + [(value(p, own), start + own * h) for own in spots], key=lambda own: own[0])
        return best

    def product(self, first, second):
        """Integral of a product of two forms over the phase."""
        total = mpf(0)
        for _, h, s, series in self.pieces:
            p = polynomial(first, series)
            q = p if second is first else polynomial(second, series)
            powers = [s ** (k + 1) / (k + 1) for k in range(DEGREE + 1)]
            # Terms beyond the degree are as small as those that the series leaves out.
            total += h * sum(
                p[i] * sum(q[j] * powers[i + j] for j in range(DEGREE + 1 - i)) for i in range(DEGREE + 1) if p[i]
            )
        return total

    def lost(self):
        return sum((C * self.product(rate, rate) for C, rate in self.mode.losses), mpf(0))


def follow(modes, name, state, horizon, switch, start=mpf(0), verify=True):
    """Arcs of a motion. `switch(mode, event, state, time)` returns the next mode and state, or None to stop."""
    arcs, time = [], start
    while time < horizon:
        arc = Arc(modes[name], state, time, horizon, verify)
        arc.name = name
        arcs.append(arc)
        if arc.event is None:
            break
        time = arc.end
        following = switch(name, arc.event, dict(arc.final), time)
        if following is None:
            break
        name, state = following
    return arcs


def peak(arcs, force):
    """Largest of a form per mode over several arcs: `force` maps modes to forms."""
    return max((arc.largest(force[arc.name]) for arc in arcs if arc.name in force), key=lambda own: own[0])


def balance(arcs, energy, jumps=0, work=0):
    """What was dissipated in dashpots; fails unless the energy of the start is accounted for."""
    lost = sum(arc.lost() for arc in arcs)
    before, after = energy(arcs[0].state), energy(arcs[-1].final)
    agree(before + work, after + lost + jumps, "1e-33", max(abs(before), abs(work)))
    return lost


# Nonlinear motion: Gauss-Legendre collocation with 12 stages, order 24.


class Gauss:
    def __init__(self, stages=12):
        n = stages
        nodes = []
        for i in range(n):
            x = cos(pi * (n - i - mpf(1) / 4) / (n + mpf(1) / 2))
            for _ in range(8):
                own, other = legendre(n, x), legendre(n - 1, x)
                x -= own * (1 - x * x) / (n * (other - x * own))
            nodes.append(x)
        P = [[legendre(k, x) for x in nodes] for k in range(n + 1)]
        assert len(set(nstr(x, 5) for x in nodes)) == n and max(map(abs, P[n])) < mpf(10) ** (8 - mp.dps)
        self.c = [(x + 1) / 2 for x in nodes]
        self.b = [1 / sum((2 * k + 1) * P[k][i] ** 2 for k in range(n)) for i in range(n)]
        rise = [self.c] + [[(P[k + 1][i] - P[k - 1][i]) / (2 * (2 * k + 1)) for i in range(n)] for k in range(1, n)]
        self.a = [
            [self.b[j] * sum((2 * k + 1) * P[k][j] * rise[k][i] for k in range(n)) for j in range(n)] for i in range(n)
        ]

    def step(self, rate, t, z, h):
        stages = [list(z) for _ in self.c]
        for _ in range(300):
            slopes = [rate(t + c * h, own) for c, own in zip(self.c, stages)]
            following = [
                [z[d] + h * sum(a * f[d] for a, f in zip(row, slopes)) for d in range(len(z))] for row in self.a
            ]
            change = max(abs(p - q) for own, other in zip(following, stages) for p, q in zip(own, other))
            stages = following
            if change <= mpf(10) ** (3 - mp.dps) * max(abs(own) for own in z + stages[-1]):
                slopes = [rate(t + c * h, own) for c, own in zip(self.c, stages)]
                return [z[d] + h * sum(b * f[d] for b, f in zip(self.b, slopes)) for d in range(len(z))]
        raise ArithmeticError("no convergence")

    def over(self, rate, t, z, end, steps):
        h = (end - t) / steps
        for k in range(steps):
            z = self.step(rate, t + k * h, z, h)
        return z

    def until(self, rate, t, z, h, guard, limit=10000):
        """Time and state where guard(z), positive after the start, becomes zero; a secant on the last step."""
        for _ in range(limit):
            following = self.step(rate, t, z, h)
            if guard(following) > 0:
                t, z = t + h, following
                continue
            # Bracketed secant (Illinois) on the length of the last step.
            low, high, at_low, at_high = mpf(0), h, guard(z), guard(following)
            for _ in range(200):
                own = (low * at_high - high * at_low) / (at_high - at_low)
                there = self.step(rate, t, z, own)
                here = guard(there)
                if abs(here) <= mpf(10) ** (8 - mp.dps) * max(abs(at_low), abs(guard(z))) or here == 0:
                    return t + own, there
                if here > 0:
                    low, at_low, at_high = own, here, at_high / 2
                else:
                    high, at_high, at_low = own, here, at_low / 2
            raise ArithmeticError("no crossing")
        raise ArithmeticError("no crossing within the limit")


# 1. Kelvin-Voigt pads.


def kelvin_voigt():
    for zeta in ("0.05", "0.3", "0.9", "1", "1.5"):
        case = Case(f"kv-zeta-{zeta}")
        m, V, K = case.params(m=5, V=4, K=2e5)
        C = case.param("C", float(2000 * mpf(zeta)))
        omega, damping = sqrt(K / m), C / (2 * sqrt(K * m))
        if damping < 1:
            ratio = acos(damping) / sqrt(1 - damping**2)
        elif damping > 1:
            ratio = acosh(damping) / sqrt(damping**2 - 1)
        else:
            ratio = mpf(1)
        restitution, release = exp(-2 * damping * ratio), 2 * ratio / omega
        x, v = unknowns("x v")
        force = K * x + C * v
        mode = Mode({"x": v, "v": -force / m}, {"release": force}, [(C, v)])
        arc = Arc(mode, {"x": mpf(0), "v": V}, mpf(0), 1 / mpf(2))
        agree(arc.end, release)
        agree(-arc.final["v"], restitution * V)
        agree(arc.final["x"], C * restitution * V / K)
        deepest, when = arc.largest(x)
        # v vanishes at half the release time.
        agree(when, release / 2)
        agree(deepest, V / omega * exp(-damping * ratio))
        most, most_time = arc.largest(force)
        lost = balance([arc], lambda s: m * s["v"] ** 2 / 2 + K * s["x"] ** 2 / 2)
        case.give("release.time", release)
        case.give("release.velocity", -restitution * V)
        case.give("release.deformation", C * restitution * V / K)
        case.give("restitution", restitution)
        case.give("peak-deformation", deepest)
        case.give("peak-deformation.time", when)
        case.give("peak-force", most)
        case.give("peak-force.time", most_time)
        case.give("dissipated", lost)
        case.give("impulse", m * V * (1 + restitution))
        # The free face afterwards: C d' = -K d.
        face_time = case.param("face-time", 0.04)
        case.give("face-time.deformation", arc.final["x"] * exp(-K / C * (face_time - release)))


def bouncing_kv(case, m, K, C, V, g, horizon):
    """Mass on a pad with a free face under gravity until it rests. Returns the arcs; modes "closed" and "open"."""
    x, v, d = unknowns("x v d")
    force = K * x + C * v
    modes = {
        "closed": Mode({"x": v, "v": g - force / m, "d": v}, {"release": force}, [(C, v)]),
        "open": Mode({"x": v, "v": lift(g), "d": -K / C * d}, {"touch": d - x}, [(C, -K / C * d)]),
    }

    def switch(mode, event, state, time):
        if event == "release":
            return "open", state | {"d": state["x"]}
        return "closed", state | {"d": state["x"]}

    arcs = follow(modes, "closed", {"x": mpf(0), "v": V, "d": mpf(0)}, horizon, switch)
    # The energy of the oscillation about the place of rest bounds all further forces.
    last = arcs[-1]
    assert last.name == "closed" and last.event is None
    off = last.final["x"] - m * g / K
    bound = sqrt(m * last.final["v"] ** 2 + K * off**2) * (sqrt(K) + C / sqrt(m))
    assert bound < m * g, "not yet at rest"
    lost = balance(arcs, lambda s: m * s["v"] ** 2 / 2 + K * s["d"] ** 2 / 2 - m * g * s["x"])
    return arcs, force, lost


def report_bounces(case, arcs, force, lost):
    releases = touches = 0
    for arc in arcs:
        if arc.name == "closed":
            touches += 1
            most, when = arc.largest(force)
            if touches > 1:
                case.give(f"touch-{touches}.time", arc.start)
                case.give(f"touch-{touches}.velocity", arc.state["v"])
                case.give(f"touch-{touches}.face-position", arc.state["x"])
            case.give(f"peak-force-{touches}", most)
            case.give(f"peak-force-{touches}.time", when)
            deepest, deepest_time = arc.largest(unknowns("x")[0])
            case.give(f"peak-deformation-{touches}", deepest)
            case.give(f"peak-deformation-{touches}.time", deepest_time)
            if arc.event:
                releases += 1
                case.give(f"release-{releases}.time", arc.end)
                case.give(f"release-{releases}.velocity", arc.final["v"])
                case.give(f"release-{releases}.deformation", arc.final["x"])
    case.give("releases", releases)
    case.give("dissipated", lost)
    if len(arcs) > 1:
        case.give("end.position", arcs[-1].final["x"])
        case.give("end.velocity", arcs[-1].final["v"])


def kelvin_voigt_gravity():
    for name, C, V in (("0.05", 100, 4), ("0.3", 600, 4), ("0.9", 1800, 4), ("0.9-slow", 1800, 0.1)):
        case = Case(f"kv-gravity-zeta-{name}")
        m, V, K, C, g = case.params(m=5, V=V, K=2e5, C=C, g=G0)
        x, v = unknowns("x v")
        force = K * x + C * v
        mode = Mode({"x": v, "v": g - force / m}, {"release": force}, [(C, v)])
        arc = Arc(mode, {"x": mpf(0), "v": V}, mpf(0), mpf("0.3"))
        energy = lambda s: m * s["v"] ** 2 / 2 + K * s["x"] ** 2 / 2 - m * g * s["x"]
        lost = balance([arc], energy)
        # Closed form around the place of rest: x = r + exp(-s t) (a cos w t + b sin w t).
        s = C / (2 * m)
        w, r = sqrt(K / m - s * s), m * g / K
        a, b = -r, (V - s * r) / w
        place = lambda t: r + exp(-s * t) * (a * cos(w * t) + b * sin(w * t))
        speed = lambda t: exp(-s * t) * ((b * w - s * a) * cos(w * t) - (a * w + s * b) * sin(w * t))
        agree(arc.final["x"], place(arc.end))
        agree(arc.final["v"], speed(arc.end), "1e-30", V)
        case.give("releases", 1 if arc.event else 0)
        if arc.event:
            agree(K * place(arc.end), -C * speed(arc.end))
            case.give("release.time", arc.end)
            case.give("release.velocity", arc.final["v"])
            case.give("release.deformation", arc.final["x"])
            case.give("restitution", -arc.final["v"] / V)
            case.give("dissipated", lost)
        else:
            # What is left cannot reach zero force any more.
            left = sqrt(m * arc.final["v"] ** 2 + K * (arc.final["x"] - r) ** 2)
            assert left * (sqrt(K) + C / sqrt(m)) < m * g
            case.give("rest.deformation", r)
            case.give("smallest-force", -arc.largest(-force)[0])
            case.give("smallest-force.time", arc.largest(-force)[1])
        most, when = arc.largest(force)
        case.give("peak-force", most)
        case.give("peak-force.time", when)
        deepest, when = arc.largest(x)
        case.give("peak-deformation", deepest)
        case.give("peak-deformation.time", when)


def kelvin_voigt_bouncing():
    case = Case("kv-bouncing")
    m, V, K, C, g, horizon = case.params(m=5, V=1.5, K=2e5, C=200, g=G0, horizon=1.25)
    arcs, force, lost = bouncing_kv(case, m, K, C, V, g, horizon)
    report_bounces(case, arcs, force, lost)


# 2. Maxwell and Zener pads.


def maxwell():
    for name, C in (("releases", 2000), ("never-releases", 400), ("critical", 500)):
        case = Case(f"maxwell-{name}")
        m, V, K, C = case.params(m=5, V=4, K=2e5, C=C)
        horizon = case.param("horizon", 0.05)
        v, u, d = unknowns("v u d")
        force = K * u
        rate = force / C
        mode = Mode({"v": -force / m, "u": v - rate, "d": rate}, {"release": force}, [(C, rate)])
        arc = Arc(mode, {"v": V, "u": mpf(0), "d": mpf(0)}, mpf(0), horizon)
        lost = balance([arc], lambda s: m * s["v"] ** 2 / 2 + K * s["u"] ** 2 / 2)
        case.give("releases", 1 if arc.event else 0)
        most, when = arc.largest(force)
        s = K / (2 * C)
        if arc.event:
            w = sqrt(K / m - s * s)
            restitution = exp(-pi * s / w)
            agree(arc.end, pi / w)
            agree(-arc.final["v"], V * restitution)
            agree(arc.final["d"], m * V * (1 + restitution) / C)
            agree(when, atan(w / s) / w)
            case.give("release.time", pi / w)
            case.give("release.velocity", -V * restitution)
            case.give("release.deformation", m * V * (1 + restitution) / C)
            case.give("restitution", restitution)
            case.give("dissipated", lost)
        else:
            assert C <= sqrt(K * m) / 2
            # Force K V t exp(-s t) or the overdamped form: positive for all times.
            root = sqrt(s * s - K / m)
            shape = horizon if root == 0 else (exp(root * horizon) - exp(-root * horizon)) / (2 * root)
            agree(force.of(arc.final), K * V * exp(-s * horizon) * shape)
            case.give("horizon.force", force.of(arc.final))
            case.give("horizon.velocity", arc.final["v"])
            case.give("horizon.deformation", arc.final["u"] + arc.final["d"])
            case.give("limit.deformation", m * V / C)
        case.give("peak-force", most)
        case.give("peak-force.time", when)
        deepest, when = arc.largest(u + d)
        case.give("peak-deformation", deepest)
        case.give("peak-deformation.time", when)


def zener_modes(m, K0, K1, C1, g):
    """Unknown q is the deformation of the dashpot, x the place of the mass."""
    x, v, q = unknowns("x v q")
    face = K1 / (K0 + K1) * q
    force = K0 * x + K1 * (x - q)
    closed, free = K1 / C1 * (x - q), K1 / C1 * (face - q)
    modes = {
        "closed": Mode({"x": v, "v": g - force / m, "q": closed}, {"release": force}, [(C1, closed)]),
        "open": Mode({"x": v, "v": lift(g), "q": free}, {"touch": face - x}, [(C1, free)]),
    }

    def energy(mode):
        y = x if mode == "closed" else face
        return lambda s: (m * s["v"] ** 2 + K0 * y.of(s) ** 2 + K1 * (y - q).of(s) ** 2) / 2 - m * g * s["x"]

    return modes, force, face, energy


def zener():
    case = Case("zener")
    m, V, K0, K1, C1, horizon = case.params(m=5, V=4, K0=1e5, K1=2e5, C1=600, horizon=0.04)
    modes, force, face, energy = zener_modes(m, K0, K1, C1, mpf(0))
    switch = lambda mode, event, state, time: ("open" if mode == "closed" else "closed", state)
    arcs = follow(modes, "closed", {"x": mpf(0), "v": V, "q": mpf(0)}, horizon, switch)
    assert [arc.event for arc in arcs] == ["release", None]
    lost = [arc.lost() for arc in arcs]
    agree(m * V**2 / 2, energy("closed")(arcs[0].final) + lost[0])
    agree(energy("closed")(arcs[0].final), energy("open")(arcs[1].final) + lost[1])
    release, deformation = arcs[0].end, arcs[0].final["x"]
    retardation = C1 * (K0 + K1) / (K0 * K1)
    agree(face.of(arcs[1].final), deformation * exp(-(horizon - release) / retardation))
    report_bounces(case, arcs[:1], force, lost[0])
    case.give("horizon.face-position", face.of(arcs[1].final))
    case.give("horizon.mass-position", arcs[1].final["x"])
    case.give("release-1.face-velocity-before", arcs[0].final["v"])
    case.give("release-1.face-velocity-after", -deformation / retardation)
    case.give("horizon.dissipated", sum(lost))
    case.give("restitution", -arcs[0].final["v"] / V)

    for name, V, C1, horizon in (("", 0.5, 300, 0.5), ("-slow-face", 1, 2500, 1)):
        case = Case("zener-bouncing" + name)
        m, V, K0, K1, C1, g, horizon = case.params(m=5, V=V, K0=1e5, K1=2e5, C1=C1, g=G0, horizon=horizon)
        modes, force, face, energy = zener_modes(m, K0, K1, C1, g)
        arcs = follow(modes, "closed", {"x": mpf(0), "v": V, "q": mpf(0)}, horizon, switch)
        assert arcs[-1].name == "closed" and arcs[-1].event is None
        lost = sum(arc.lost() for arc in arcs)
        agree(m * V**2 / 2, energy("closed")(arcs[-1].final) + lost, "1e-33")
        report_bounces(case, arcs, force, lost)
        # The rest: no further zero of the force, because the amplitude has died away.
        agree(arcs[-1].final["x"], m * g / K0, "1e-2")


# 3. The thesis' reference case with separation at the head.


def burgers():
    # On the soft mount the panel runs ahead of the head, swings back and meets it again.
    variants = (("", 50e6, 1e4, 0.02), ("-stiff", 50e6, 1e7, 0.02), ("-soft-mount", 2e6, 1e3, 0.03))
    for name, K3, C3, horizon in variants:
        case = Case("burgers-separation" + name)
        m1, V, K1, C1, K2, C2 = case.params(m1=10, V=10, K1=20e6, C1=4000, K2=20e6, C2=6000)
        m3, K3, C3, horizon = case.params(m3=100, K3=K3, C3=C3, horizon=horizon)
        x1, v1, x2, v2, e1, e2 = unknowns("x1 v1 x2 v2 e1 e2")
        force = K2 * (x1 - x2 - e1 - e2)
        mount = K3 * x2 + C3 * v2
        face = x2 + e1 + e2
        kelvin = (force - K1 * e1) / C1
        modes = {
            "closed": Mode(
                {"x1": v1, "v1": -force / m1, "x2": v2, "v2": (force - mount) / m3, "e1": kelvin, "e2": force / C2},
                {"release": force},
                [(C1, kelvin), (C2, force / C2), (C3, v2)],
            ),
            "open": Mode(
                {"x1": v1, "v1": lift(0), "x2": v2, "v2": -mount / m3, "e1": -K1 / C1 * e1, "e2": lift(0)},
                {"touch": face - x1},
                [(C1, -K1 / C1 * e1), (C3, v2)],
            ),
        }
        switch = lambda mode, event, state, time: ("open" if mode == "closed" else "closed", state)
        zero = {own: mpf(0) for own in modes["open"].names}
        arcs = follow(modes, "closed", zero | {"v1": V}, horizon, switch)

        def energy(s, closed):
            spring = K2 * (s["x1"] - s["x2"] - s["e1"] - s["e2"]) ** 2 / 2 if closed else 0
            return spring + (
                m1 * s["v1"] ** 2 + m3 * s["v2"] ** 2 + K3 * s["x2"] ** 2 + K1 * s["e1"] ** 2
            ) / 2

        lost = [arc.lost() for arc in arcs]
        agree(m1 * V**2 / 2, energy(arcs[-1].final, arcs[-1].name == "closed") + sum(lost))
        known = {"": "7.425568132", "-stiff": "5.822143300"}
        if name in known:
            agree(arcs[0].end * 1000, mpf(known[name]), "1e-9")
        counts = {"release": 0, "touch": 1}
        for arc in arcs:
            if arc.name == "closed":
                most, when = arc.largest(force)
                case.give(f"peak-force-{counts['touch']}", most)
                case.give(f"peak-force-{counts['touch']}.time", when)
            if arc.event:
                counts[arc.event] += 1
                label = f"{arc.event}-{counts[arc.event]}"
                case.give(f"{label}.time", arc.end)
                case.give(f"{label}.head-velocity", arc.final["v1"])
                case.give(f"{label}.face-position", face.of(arc.final))
                case.give(f"{label}.panel-position", arc.final["x2"])
                case.give(f"{label}.panel-velocity", arc.final["v2"])
        deepest, when = peak(arcs, {"closed": x1 - x2, "open": e1 + e2})
        case.give("peak-deformation", deepest)
        case.give("peak-deformation.time", when)
        case.give("releases", counts["release"])
        case.give("touches", counts["touch"])
        final, touching = arcs[-1].final, arcs[-1].name == "closed"
        case.give("horizon.head-velocity", final["v1"])
        case.give("horizon.head-position", final["x1"])
        case.give("horizon.panel-position", final["x2"])
        case.give("horizon.panel-velocity", final["v2"])
        where = x1 if touching else face
        case.give("horizon.face-position", where.of(final))
        case.give("horizon.deformation", (where - x2).of(final))
        case.give("horizon.dissipated", sum(lost))
        case.give("release-1.dissipated", lost[0])
        if counts["release"] == 1:
            # The mount alone in closed form, from the release on.
            first, t = arcs[0].final, horizon - arcs[0].end
            s = C3 / (2 * m3)
            w = sqrt(mpc(K3 / m3 - s * s))
            place = exp(-s * t) * (first["x2"] * cos(w * t) + (first["v2"] + s * first["x2"]) / w * sin(w * t))
            agree(final["x2"], place.real)


# 4. Stops.


def rigid_stop():
    """Kelvin-Voigt pad with a rigid stop at the deformation d; the head may leave the pad."""
    for name, C in (("", 300), ("-release-at-once", 1000)):
        case = Case("stop-rigid" + name)
        m, V, K, C = case.params(m=10, V=3, K=1e5, C=C)
        d, e = case.params(d=0.01, e=0.6)
        x, v = unknowns("x v")
        force = K * x + C * v
        mode = Mode({"x": v, "v": -force / m}, {"stop": d - x, "release": force}, [(C, v)])
        switch = lambda mode, event, s, time: ("closed", s | {"x": d, "v": -e * s["v"]}) if event == "stop" else None
        arcs = follow({"closed": mode}, "closed", {"x": mpf(0), "v": V}, mpf(1), switch)
        assert [arc.event for arc in arcs] == ["stop", "release"]
        speed = arcs[0].final["v"]
        jump = m * speed**2 * (1 - e * e) / 2
        lost = balance(arcs, lambda s: m * s["v"] ** 2 / 2 + K * s["x"] ** 2 / 2, jumps=jump)
        # Second way: x(t) in closed form.
        s = C / (2 * m)
        w = sqrt(mpc(K / m - s * s))
        agree((V / w * exp(-s * arcs[0].end) * sin(w * arcs[0].end)).real, d)
        case.give("stop-1.time", arcs[0].end)
        case.give("stop-1.velocity-before", speed)
        case.give("stop-1.velocity-after", -e * speed)
        case.give("stop-1.impulse", m * speed * (1 + e))
        case.give("stop-1.energy-lost", jump)
        case.give("stop-1.pad-force-before", K * d + C * speed)
        case.give("stop-1.pad-force-after", K * d - C * e * speed)
        case.give("release.time", arcs[1].end)
        case.give("release.velocity", arcs[1].final["v"])
        case.give("release.deformation", arcs[1].final["x"])
        case.give("dissipated-in-pad", lost)
        most, when = arcs[0].largest(force)
        case.give("peak-force", most)
        case.give("peak-force.time", when)
        assert (K * d < C * e * speed) == (arcs[1].end == arcs[0].end)


def stop_chatter():
    """A constant load presses the head through the pad onto the stop, where it comes to rest."""
    case = Case("stop-chatter")
    m, V, K, C, d, e, load = case.params(m=10, V=1, K=1e5, C=300, d=0.01, e=0.5, load=3000)
    x, v = unknowns("x v")
    force = K * x + C * v
    mode = Mode({"x": v, "v": (load - force) / m}, {"stop": d - x, "release": force}, [(C, v)])
    state, time, touches, lost, jumps = {"x": mpf(0), "v": V}, mpf(0), [], mpf(0), mpf(0)
    while True:
        arc = Arc(mode, state, time, mpf(1), verify=len(touches) < 4)
        assert arc.event == "stop"
        lost += arc.lost()
        time, speed = arc.end, arc.final["v"]
        touches.append((time, speed))
        jumps += m * speed**2 * (1 - e * e) / 2
        state = {"x": d, "v": -e * speed}
        if speed < mpf(10) ** -28:
            break
    # What is left of the times is geometric: the flight lasts 2 e v/a, and each is e times the one before.
    pull = (load - K * d) / m
    limit = time + 2 * e * speed / pull / (1 - e)
    agree(m * V**2 / 2 + load * d, K * d**2 / 2 + lost + jumps)
    for k in range(8):
        case.give(f"stop-{k + 1}.time", touches[k][0])
        case.give(f"stop-{k + 1}.velocity-before", touches[k][1])
    case.give("rest.time", limit)
    case.give("rest.pad-force", K * d)
    case.give("rest.stop-force", load - K * d)
    case.give("dissipated-in-pad", lost)
    case.give("lost-at-stop", jumps)


def stiff_stop():
    """The stop is a Kelvin-Voigt element with a free face of its own; so is the pad."""
    case = Case("stop-stiff")
    m, V, K, C, d, Ks, Cs = case.params(m=10, V=3, K=1e5, C=300, d=0.01, Ks=2e6, Cs=1000)
    horizon = case.param("horizon", 0.04)
    x, v, p, s = unknowns("x v p s")
    pad, stop = K * x + C * v, Ks * (x - d) + Cs * v
    free_p, free_s = -K / C * p, -Ks / Cs * s
    modes = {}
    for on in (False, True):
        for held in (False, True):
            push = (pad if on else lift(0)) + (stop if held else lift(0))
            guards = {"pad-release": pad} if on else {"pad-touch": p - x}
            guards |= {"stop-release": stop} if held else {"stop-touch": d + s - x}
            rates = {"x": v, "v": -push / m, "p": v if on else free_p, "s": v if held else free_s}
            modes[on, held] = Mode(rates, guards, [(C, rates["p"]), (Cs, rates["s"])])

    def switch(mode, event, state, time):
        on, held = mode
        if event.startswith("pad"):
            on = not on
            state["p"] = state["x"]
        else:
            held = not held
            state["s"] = state["x"] - d
        return (on, held), state

    zero = {own: mpf(0) for own in ("x", "p", "s")}
    arcs = follow(modes, (True, False), zero | {"v": V}, horizon, switch)
    lost = balance(arcs, lambda z: (m * z["v"] ** 2 + K * z["p"] ** 2 + Ks * z["s"] ** 2) / 2)
    events = [arc.event for arc in arcs]
    assert events == ["stop-touch", "stop-release", "pad-release", None], events
    names = ("stop-touch", "stop-release", "pad-release")
    for name, arc in zip(names, arcs):
        case.give(f"{name}.time", arc.end)
        case.give(f"{name}.velocity", arc.final["v"])
        case.give(f"{name}.deformation", arc.final["x"])
    case.give("stop-touch.stop-force-after", Cs * arcs[0].final["v"])
    most, when = arcs[1].largest(stop)
    case.give("stop.peak-force", most)
    case.give("stop.peak-force.time", when)
    most, when = max(arc.largest(pad) for arc in arcs[:3])
    case.give("pad.peak-force", most)
    case.give("pad.peak-force.time", when)
    most, when = arcs[1].largest(pad + stop)
    case.give("total.peak-force", most)
    case.give("total.peak-force.time", when)
    most, when = arcs[1].largest(x)
    case.give("peak-deformation", most)
    case.give("peak-deformation.time", when)
    case.give("stop.dissipated", sum(Cs * arc.product(arc.mode.losses[1][1], arc.mode.losses[1][1]) for arc in arcs))
    case.give("pad.dissipated", sum(C * arc.product(arc.mode.losses[0][1], arc.mode.losses[0][1]) for arc in arcs))
    case.give("horizon.stop-deformation", arcs[-1].final["s"])
    case.give("horizon.pad-deformation", arcs[-1].final["p"])
    # The free face of the stop relaxes in closed form.
    gone = horizon - arcs[1].end
    agree(arcs[-1].final["s"], (arcs[1].final["x"] - d) * exp(-Ks / Cs * gone), "1e-25")


# 5. Bouncing on rigid and on springy ground.


def bounce_rigid():
    case = Case("bounce-rigid")
    m, h, e, g = case.params(m=2, h=1.5, e=0.8, g=G0)
    first = sqrt(2 * h / g)
    time, speed, lost = first, sqrt(2 * g * h), mpf(0)
    for k in range(1, 21):
        # Second way: the sum of the flights so far.
        agree(time, first * (1 + 2 * e * (1 - e ** (k - 1)) / (1 - e)))
        case.give(f"touch-{k}.time", time)
        case.give(f"touch-{k}.velocity-before", speed)
        lost += m * speed**2 * (1 - e * e) / 2
        speed *= e
        time += 2 * speed / g
    agree(lost, m * g * h * (1 - e**40))
    case.give("touch-20.energy-lost-so-far", lost)
    case.give("rest.time", first * (1 + e) / (1 - e))
    case.give("rest.energy-lost", m * g * h)


def bounce_spring():
    case = Case("bounce-spring")
    m, h, K, g = case.params(m=2, h=0.5, K=2e4, g=G0)
    fall, V, omega = sqrt(2 * h / g), sqrt(2 * g * h), sqrt(K / m)
    contact = 2 * (pi - atan(omega * V / g)) / omega
    deepest = m * g / K + sqrt((m * g / K) ** 2 + m * V**2 / K)
    x, v = unknowns("x v")
    modes = {
        "open": Mode({"x": v, "v": lift(g)}, {"touch": -x}),
        "closed": Mode({"x": v, "v": g - K / m * x}, {"release": K * x}),
    }

    def switch(mode, event, state, time):
        return ("open" if mode == "closed" else "closed"), state | {"x": mpf(0)}

    arcs = follow(modes, "open", {"x": -h, "v": mpf(0)}, 6 * fall, switch)
    agree(arcs[0].end, fall)
    agree(arcs[1].end, fall + contact)
    agree(arcs[2].end, 3 * fall + contact)
    agree(arcs[1].largest(x)[0], deepest)
    agree(arcs[2].final["v"], V)
    # The fall of the centre of mass in a period: momentum of the force is that of the weight.
    agree(K * arcs[1].product(x, lift(1)), m * g * (2 * fall + contact))
    for k in range(1, 6):
        start = fall + (k - 1) * (2 * fall + contact)
        case.give(f"touch-{k}.time", start)
        case.give(f"release-{k}.time", start + contact)
    case.give("touch.velocity", V)
    case.give("contact-time", contact)
    case.give("period", 2 * fall + contact)
    case.give("peak-deformation", deepest)
    case.give("peak-force", K * deepest)
    case.give("energy", m * g * h)


# 6. A face with mass.


def face_modes(m1, m2, K, C, g):
    """Impactor x1 against a face x2 on a pad that is fixed to it."""
    x1, v1, x2, v2 = unknowns("x1 v1 x2 v2")
    pad = K * x2 + C * v2
    together = g - pad / (m1 + m2)
    contact = m1 * (g - together)
    modes = {
        "closed": Mode({"x1": v1, "v1": together, "x2": v2, "v2": together}, {"release": contact}, [(C, v2)]),
        "open": Mode({"x1": v1, "v1": lift(g), "x2": v2, "v2": g - pad / m2}, {"touch": x2 - x1}, [(C, v2)]),
    }
    weight = lambda s: g * (m1 * s["x1"] + m2 * s["x2"])
    energy = lambda s: (m1 * s["v1"] ** 2 + m2 * s["v2"] ** 2 + K * s["x2"] ** 2) / 2 - weight(s)
    return modes, pad, contact, energy


def shock(m1, m2, e, state):
    """Velocities after a collision, and the energy that it takes."""
    v1, v2 = state["v1"], state["v2"]
    centre, closing = (m1 * v1 + m2 * v2) / (m1 + m2), v1 - v2
    after = state | {
        "v1": centre - e * m2 * closing / (m1 + m2),
        "v2": centre + e * m1 * closing / (m1 + m2),
        "x1": state["x2"],
    }
    return after, m1 * m2 / (m1 + m2) * closing**2 * (1 - e * e) / 2


def face_plastic():
    for name, V, g, horizon in (("", 4, 0, 0.05), ("-gravity", 1, G0, 0.5)):
        case = Case("face-plastic" + name)
        m1, m2, V, K, C, g, horizon = case.params(m1=5, m2=0.5, V=V, K=2e5, C=200, g=g, horizon=horizon)
        modes, pad, contact, energy = face_modes(m1, m2, K, C, g)
        state, taken = shock(m1, m2, 0, {"x1": mpf(0), "v1": V, "x2": mpf(0), "v2": mpf(0)})
        losses = [taken]
        agree(state["v1"], m1 * V / (m1 + m2))
        agree(taken, m1 * m2 / (m1 + m2) * V**2 / 2)

        def switch(mode, event, state, time):
            if event == "release":
                return "open", state
            state, taken = shock(m1, m2, 0, state)
            losses.append(taken)
            return "closed", state

        arcs = follow(modes, "closed", state, horizon, switch)
        lost = balance(arcs, energy, jumps=sum(losses[1:]))
        case.give("touch-1.velocity-after", state["v1"])
        case.give("touch-1.energy-lost", taken)
        case.give("touch-1.impulse", m1 * (V - state["v1"]))
        touches = releases = 0
        for arc in arcs:
            if arc.name == "closed":
                touches += 1
                if touches > 1:
                    case.give(f"touch-{touches}.time", arc.start)
                    case.give(f"touch-{touches}.velocity-after", arc.state["v1"])
                    case.give(f"touch-{touches}.position", arc.state["x1"])
                    case.give(f"touch-{touches}.energy-lost", losses[touches - 1])
                most, when = arc.largest(contact)
                case.give(f"peak-F1-{touches}", most)
                case.give(f"peak-F1-{touches}.time", when)
                most, when = arc.largest(pad)
                case.give(f"peak-F2-{touches}", most)
                case.give(f"peak-F2-{touches}.time", when)
                if arc.event:
                    releases += 1
                    case.give(f"release-{releases}.time", arc.end)
                    case.give(f"release-{releases}.velocity", arc.final["v1"])
                    case.give(f"release-{releases}.position", arc.final["x1"])
            else:
                most, when = arc.largest(-pad)
                case.give(f"largest-pull-of-pad-{releases}", most)
                case.give(f"largest-pull-of-pad-{releases}.time", when)
        case.give("touches", touches)
        case.give("releases", releases)
        case.give("horizon.impactor-position", arcs[-1].final["x1"])
        case.give("horizon.impactor-velocity", arcs[-1].final["v1"])
        case.give("horizon.face-position", arcs[-1].final["x2"])
        case.give("horizon.face-velocity", arcs[-1].final["v2"])
        case.give("dissipated-in-pad", lost)
        case.give("lost-at-touches", sum(losses))
        if not g:
            # Kelvin-Voigt release of the joined masses in closed form.
            M = m1 + m2
            damping = C / (2 * sqrt(K * M))
            agree(arcs[0].end, 2 * acos(damping) / sqrt(1 - damping**2) / sqrt(K / M))


def face_restitution():
    """Touches with restitution accumulate in finite time; then impactor and face go on together."""
    case = Case("face-restitution")
    m1, m2, V, K, C, e, horizon = case.params(m1=5, m2=0.5, V=4, K=2e5, C=200, e=0.5, horizon=0.05)
    modes, pad, contact, energy = face_modes(m1, m2, K, C, mpf(0))
    state, time = {"x1": mpf(0), "v1": V, "x2": mpf(0), "v2": mpf(0)}, mpf(0)
    start, touches, jumps, lost = energy(state), [], mpf(0), mpf(0)
    peaks = []
    while True:
        closing = state["v1"] - state["v2"]
        before = dict(state)
        state, taken = shock(m1, m2, e, state)
        jumps += taken
        touches.append((time, before, state))
        if closing < mpf(10) ** -28:
            break
        arc = Arc(modes["open"], state, time, horizon, verify=len(touches) < 4)
        assert arc.event == "touch"
        peaks.append(arc.largest(pad))
        lost += arc.lost()
        time, state = arc.end, arc.final
    # The rest is geometric: flights of 2 e w/a, each e times the one before; a is how the pad brakes the face.
    limit = time + 2 * e * closing / (pad.of(state) / m2) / (1 - e)
    state, taken = shock(m1, m2, 0, state)
    arcs = follow(modes, "closed", state, horizon, lambda mode, event, state, time: ("open", state), start=limit)
    assert [arc.event for arc in arcs] == ["release", None]
    for arc in arcs:
        lost += arc.lost()
    agree(start, energy(arcs[-1].final) + lost + jumps, "1e-25")
    for k in range(8):
        when, before, after = touches[k]
        case.give(f"touch-{k + 1}.time", when)
        case.give(f"touch-{k + 1}.impactor-velocity-before", before["v1"])
        case.give(f"touch-{k + 1}.impactor-velocity-after", after["v1"])
        case.give(f"touch-{k + 1}.face-velocity-before", before["v2"])
        case.give(f"touch-{k + 1}.face-velocity-after", after["v2"])
    case.give("joined.time", limit)
    case.give("joined.velocity", arcs[0].state["v1"])
    case.give("joined.position", arcs[0].state["x1"])
    most, when = arcs[0].largest(contact)
    case.give("joined.peak-F1", most)
    case.give("joined.peak-F1.time", when)
    most, when = max(peaks + [arcs[0].largest(pad)])
    case.give("peak-F2", most)
    case.give("peak-F2.time", when)
    case.give("release.time", arcs[0].end)
    case.give("release.velocity", arcs[0].final["v1"])
    case.give("release.position", arcs[0].final["x1"])
    case.give("lost-at-touches", jumps)
    case.give("dissipated-in-pad", lost)
    case.give("horizon.face-position", arcs[1].final["x2"])
    case.give("horizon.face-velocity", arcs[1].final["v2"])


# 7. Two interfaces: head | pad 1 - plate | pad 2 - ground.


def two_interfaces():
    variants = (("", 2, 2e5, 150, 4e5, 200, 0.03), ("-pad2-first", 5, 3e4, 300, 3e5, 30, 0.05))
    for name, m2, K1, C1, K2, C2, horizon in variants:
        case = Case("two-interfaces" + name)
        m1, V, K1, C1 = case.params(m1=5, V=4, K1=K1, C1=C1)
        m2, K2, C2, horizon = case.params(m2=m2, K2=K2, C2=C2, horizon=horizon)
        x1, v1, x2, v2, p, q = unknowns("x1 v1 x2 v2 p q")
        first, second = K1 * (x1 - x2) + C1 * (v1 - v2), K2 * x2 + C2 * v2
        modes = {}
        for upper in (True, False):
            for lower in (True, False):
                top, bottom = first if upper else lift(0), second if lower else lift(0)
                guards = {"pad1-release": first} if upper else {"pad1-touch": x2 + p - x1}
                guards |= {"pad2-release": second} if lower else {"pad2-touch": q - x2}
                rates = {"x1": v1, "v1": -top / m1, "x2": v2, "v2": (top - bottom) / m2}
                rates |= {"p": v1 - v2 if upper else -K1 / C1 * p, "q": v2 if lower else -K2 / C2 * q}
                modes[upper, lower] = Mode(rates, guards, [(C1, rates["p"]), (C2, rates["q"])])

        def switch(mode, event, s, time):
            upper, lower = mode
            if event.startswith("pad1"):
                return (not upper, lower), s | {"p": s["x1"] - s["x2"]}
            return (upper, not lower), s | {"q": s["x2"]}

        zero = {own: mpf(0) for own in ("x1", "x2", "v2", "p", "q")}
        arcs = follow(modes, (True, True), zero | {"v1": V}, horizon, switch)
        energy = lambda s: (m1 * s["v1"] ** 2 + m2 * s["v2"] ** 2 + K1 * s["p"] ** 2 + K2 * s["q"] ** 2) / 2
        lost = balance(arcs, energy)
        # Momentum: what the ground has taken up.
        pushed = sum(arc.product(second, lift(1)) for arc in arcs if arc.name[1])
        final = arcs[-1].final
        agree(m1 * V - pushed, m1 * final["v1"] + m2 * final["v2"], "1e-33", m1 * V)
        counts = {"pad1-release": 0, "pad2-release": 0, "pad1-touch": 1, "pad2-touch": 1}
        for order, arc in enumerate(arcs, 1):
            if arc.event is None:
                break
            counts[arc.event] += 1
            label = f"{arc.event}-{counts[arc.event]}"
            case.give(f"{label}.order", order)
            case.give(f"{label}.time", arc.end)
            case.give(f"{label}.head-velocity", arc.final["v1"])
            case.give(f"{label}.plate-velocity", arc.final["v2"])
            case.give(f"{label}.pad1-deformation", arc.final["p"])
            case.give(f"{label}.pad2-deformation", arc.final["q"])
        for event, count in counts.items():
            case.give(f"{event}.count", count)
        for pad, force, on in (("pad1", first, 0), ("pad2", second, 1)):
            most, when = peak(arcs, {mode: force for mode in modes if mode[on]})
            case.give(f"{pad}.peak-force", most)
            case.give(f"{pad}.peak-force.time", when)
        for pad, own, C in (("pad1", 0, C1), ("pad2", 1, C2)):
            rates = [(arc, arc.mode.losses[own][1]) for arc in arcs]
            case.give(f"{pad}.dissipated", C * sum(arc.product(rate, rate) for arc, rate in rates))
        case.give("horizon.head-velocity", final["v1"])
        case.give("horizon.plate-velocity", final["v2"])
        case.give("horizon.head-position", final["x1"])
        case.give("horizon.plate-position", final["x2"])
        case.give("horizon.pad1-deformation", final["p"])
        case.give("horizon.pad2-deformation", final["q"])
        case.give("horizon.kinetic", (m1 * final["v1"] ** 2 + m2 * final["v2"] ** 2) / 2)
        case.give("horizon.stored", (K1 * final["p"] ** 2 + K2 * final["q"] ** 2) / 2)
        case.give("horizon.dissipated", lost)


# 8. Coulomb friction with true stick.


def belt():
    """A spring holds a mass on a belt that moves at the speed vb; static and kinetic friction are the same."""
    case = Case("belt-stuck")
    m, k, Fc, vb = case.params(m=2, k=800, Fc=12, vb=0.2)
    omega = sqrt(k / m)
    slip = Fc / (k * vb)
    case.give("slip.time", slip)
    case.give("slip.position", Fc / k)
    # From then on the friction is Fc and the mass swings about Fc/k, touching the belt's speed once a period.
    for k_th in (1, 2):
        case.give(f"graze-{k_th}.time", slip + 2 * pi * k_th / omega)
    for fraction in ("0.2", "0.4", "0.7", "1.3"):
        time = mpf(fraction) * 2 * pi / omega
        case.give(f"after-{fraction}-periods.position", Fc / k + vb / omega * sin(omega * time))
        case.give(f"after-{fraction}-periods.velocity", vb * cos(omega * time))
    case.give("period", 2 * pi / omega)
    # Second way: the energy of the spring and the mass under the constant friction is kept.
    place, speed = Fc / k + vb / omega * sin(mpf(1)), vb * cos(mpf(1))
    agree(m * speed**2 / 2 + k * place**2 / 2 - Fc * place, m * vb**2 / 2 - Fc**2 / (2 * k), "1e-40")

    case = Case("belt-from-rest")
    m, k, Fc, vb = case.params(m=2, k=800, Fc=12, vb=0.2)
    x, v = unknowns("x v")
    arc = Arc(Mode({"x": v, "v": (Fc - k * x) / m}, {"stick": vb - v}), {"x": mpf(0), "v": mpf(0)}, mpf(0), mpf(1))
    stick = asin(vb * k / (Fc * omega)) / omega
    place = Fc / k * (1 - cos(omega * stick))
    agree(arc.end, stick)
    agree(arc.final["x"], place)
    case.give("stick.time", stick)
    case.give("stick.position", place)
    case.give("stick.friction-force-after", k * place)
    slip = stick + (Fc / k - place) / vb
    case.give("slip.time", slip)
    case.give("slip.position", Fc / k)
    case.give("graze-1.time", slip + 2 * pi / omega)


def slider():
    case = Case("slider-free")
    m, V, Fc = case.params(m=2, V=3, Fc=12)
    case.give("stop.time", m * V / Fc)
    case.give("stop.position", m * V**2 / (2 * Fc))
    case.give("dissipated", m * V**2 / 2)

    for name, place, V in (("displaced", 0.1, 0), ("struck", 0, 2.2)):
        case = Case(f"slider-spring-{name}")
        m, k, Fc, start, V = case.params(m=2, k=800, Fc=12, x0=place, V=V)
        omega, band = sqrt(k / m), Fc / k
        x, v = unknowns("x v")
        time, state, travelled, turns = mpf(0), {"x": start, "v": V}, mpf(0), 0
        direction = 1 if V > 0 else -1
        amplitude = None
        while True:
            rates = {"x": v, "v": (-k * x - direction * Fc) / m}
            arc = Arc(Mode(rates, {"turn": direction * v}), state, time, mpf(10))
            assert arc.event == "turn"
            travelled += abs(arc.final["x"] - state["x"])
            turns += 1
            time, state = arc.end, {"x": arc.final["x"], "v": mpf(0)}
            case.give(f"turn-{turns}.time", time)
            case.give(f"turn-{turns}.position", state["x"])
            # Closed form: half cycles, each 2 Fc/k shorter than the one before.
            if turns == 1 and V > 0:
                amplitude, first = sqrt(band**2 + (V / omega) ** 2) - band, atan2(V / omega, band) / omega
                count = 0
            elif turns == 1:
                amplitude, first, count = start - 2 * band, pi / omega, 0
            else:
                count += 1
            agree(time, first + count * pi / omega)
            agree(abs(state["x"]), amplitude - 2 * band * count)
            if abs(k * state["x"]) <= Fc:
                break
            direction = -1 if state["x"] > 0 else 1
        case.give("turns", turns)
        case.give("rest.time", time)
        case.give("rest.position", state["x"])
        case.give("rest.friction-force", -k * state["x"])
        case.give("dissipated", Fc * travelled)
        agree(Fc * travelled, m * V**2 / 2 + k * (start**2 - state["x"] ** 2) / 2)


def slider_driven():
    """Sine force on a mass with spring and friction, at rest at first: it sticks and slips."""
    case = Case("slider-driven")
    m, k, Fc, P, Omega, horizon = case.params(m=2, k=800, Fc=12, P=20, Omega=8, horizon=2)
    x, v, s, c = unknowns("x v s c")
    wave = {"s": Omega * c, "c": -Omega * s}
    pull = P * s - k * x
    guards = {"slip-forward": Fc - pull, "slip-backward": Fc + pull}
    modes = {"stick": Mode({"x": lift(0), "v": lift(0)} | wave, guards)}
    for name, sign in (("forward", 1), ("backward", -1)):
        modes[name] = Mode({"x": v, "v": (pull - sign * Fc) / m} | wave, {"stop": sign * v})

    def switch(mode, event, state, time):
        if event.startswith("slip"):
            return event[5:], state
        state["v"] = mpf(0)
        force = pull.of(state)
        if abs(force) <= Fc:
            return "stick", state
        return ("forward" if force > 0 else "backward"), state

    arcs = follow(modes, "stick", {"x": mpf(0), "v": mpf(0), "s": mpf(0), "c": mpf(1)}, horizon, switch)
    agree(arcs[0].end, asin(Fc / P) / Omega)
    work = P * sum(arc.product(s, v) for arc in arcs)
    travelled = sum(abs(arc.final["x"] - arc.state["x"]) for arc in arcs)
    final = arcs[-1].final
    agree(work, Fc * travelled + k * final["x"] ** 2 / 2 + m * final["v"] ** 2 / 2)
    for number, arc in enumerate(arcs[:-1], 1):
        agree(arc.final["s"], sin(Omega * arc.end), "1e-35", 1)
        case.give(f"event-{number}.time", arc.end)
        case.give(f"event-{number}.position", arc.final["x"])
        # 0: comes to rest and sticks, 1: begins to slip forward, -1: backward, 2: turns without sticking.
        code = {"slip-forward": 1, "slip-backward": -1}.get(arc.event)
        case.give(f"event-{number}.code", code if code is not None else (0 if arcs[number].name == "stick" else 2))
    case.give("events", len(arcs) - 1)
    case.give("horizon.position", final["x"])
    case.give("horizon.velocity", final["v"])
    case.give("horizon.dissipated", Fc * travelled)
    case.give("horizon.work", work)


def slider_in_series():
    """Mass on a spring and a slider in a row, with separation: elastic, then perfectly plastic."""
    case = Case("slider-in-series")
    m, V, K, Fc = case.params(m=5, V=2, K=2e5, Fc=1000)
    omega = sqrt(K / m)
    assert V * sqrt(K * m) > Fc
    yields = asin(Fc / (V * sqrt(K * m))) / omega
    speed = V * cos(omega * yields)
    agree(m * V**2 / 2, m * speed**2 / 2 + Fc**2 / (2 * K))
    slid = m * speed**2 / (2 * Fc)
    stops = yields + m * speed / Fc
    x, v = unknowns("x v")
    arc = Arc(Mode({"x": v, "v": -K / m * x}, {"yield": Fc - K * x}), {"x": mpf(0), "v": V}, mpf(0), mpf(1))
    agree(arc.end, yields)
    agree(arc.final["v"], speed)
    case.give("yield.time", yields)
    case.give("yield.velocity", speed)
    case.give("yield.deformation", Fc / K)
    case.give("stick.time", stops)
    case.give("peak-deformation", Fc / K + slid)
    case.give("peak-force", Fc)
    case.give("permanent-set", slid)
    case.give("release.time", stops + pi / (2 * omega))
    case.give("release.velocity", -Fc / sqrt(K * m))
    case.give("restitution", Fc / (V * sqrt(K * m)))
    case.give("dissipated", Fc * slid)
    agree(Fc * slid, m * V**2 / 2 * (1 - (Fc / (V * sqrt(K * m))) ** 2))


# 9. Elastic bar with free ends, a constant force on one end from t = 0 on.


def bar():
    case = Case("bar")
    L, A, E, rho, force = case.params(L=2, A=1e-3, E=2e9, rho=1280, force=1000)
    n = 50
    case.param("segments", n)
    c = sqrt(E / rho)
    step = force / (rho * A * c)
    case.give("wave-speed", c)
    case.give("arrival.time", L / c)
    case.give("continuum.velocity-behind-front", step)
    case.give("continuum.free-end-velocity-after-arrival", 2 * step)
    case.give("continuum.struck-end-velocity-after-return", 3 * step)
    case.give("continuum.stress-behind-front", force / A)
    case.give("continuum.strain-behind-front", force / (A * E))
    times = [mpf(float(own)) for own in (0.0004, 0.0008, 0.0016, 0.0024, 0.0032, 0.0048)]
    # Impulse: the momentum of the continuum is force times time at 0.8 ms and at 2.4 ms.
    agree(rho * A * c * times[1] * step, force * times[1])
    agree(rho * A * (L * step + c * (times[3] - L / c) * step), force * times[3])
    M, k, segment = rho * A * L, n * E * A / L, rho * A * L / n
    for number, t in enumerate(times, 1):
        case.param(f"time-{number}", float(t))
    # "nodes": n springs, n + 1 masses, half masses at the ends. "cells": n equal masses, n - 1 springs.
    for name, count in (("nodes", n + 1), ("cells", n)):
        if name == "nodes":
            masses = [segment / 2] + [segment] * (n - 1) + [segment / 2]
            shape = lambda j, i: cos(j * pi * i / n)
        else:
            masses = [segment] * n
            shape = lambda j, i: cos(j * pi * (i + mpf(1) / 2) / n)
        modes = []
        for j in range(1, count):
            weight = M if name == "nodes" and j == n else M / 2
            modes.append((2 * sqrt(k / segment) * sin(j * pi / (2 * n)), weight, j))

        def velocity(i, t):
            waves = (shape(j, 0) * shape(j, i) * sin(w * t) / (weight * w) for w, weight, j in modes)
            return force * (t / M + sum(waves))

        def place(i, t):
            waves = (shape(j, 0) * shape(j, i) * (1 - cos(w * t)) / (weight * w * w) for w, weight, j in modes)
            return force * (t * t / (2 * M) + sum(waves))

        for number, t in enumerate(times, 1):
            for label, i in (("struck", 0), ("middle", n // 2), ("free", count - 1)):
                case.give(f"{name}.time-{number}.velocity-{label}", velocity(i, t))
            case.give(f"{name}.time-{number}.middle-spring-force", k * (place(n // 2 - 1, t) - place(n // 2, t)))
        speeds = [velocity(i, times[2]) for i in range(count)]
        agree(sum(m * v for m, v in zip(masses, speeds)), force * times[2])
        # Second way: Taylor series of the exponential.
        xs, vs = [unknowns(" ".join(f"{kind}{i}" for i in range(count))) for kind in "xv"]
        rates = {}
        for i in range(count):
            push = lift(force if i == 0 else 0)
            if i > 0:
                push = push + k * (xs[i - 1] - xs[i])
            if i < count - 1:
                push = push - k * (xs[i] - xs[i + 1])
            rates |= {f"x{i}": vs[i], f"v{i}": push / masses[i]}
        state = {own: mpf(0) for own in rates}
        t, mode = mpf(0), Mode({"x0": vs[0], "v0": lift(0)})
        column = {own: j for j, own in enumerate(rates)}
        mode.names = list(rates)
        mode.rows = [[(column[o], f) for o, f in own.terms.items() if o != "1"] for own in rates.values()]
        mode.constants = [own.terms.get("1", mpf(0)) for own in rates.values()]
        pieces = int(ceil(times[1] * 2 * sqrt(k / segment)))
        for _ in range(pieces):
            series = mode.series(state, times[1] / pieces)
            state = {own: value(p, mpf(1)) for own, p in series.items()}
        for i in (0, n // 2, count - 1):
            agree(state[f"v{i}"], velocity(i, times[1]), "1e-25", step)


# 10. Steady answers to a sine of the base.


def transmissibility():
    ratios = ("0.1", "0.5", "1", "sqrt2", "3", "10")
    m, K = mpf(5), mpf(2e5)
    omega = sqrt(K / m)

    def chain(case, masses, relaxances, states, K0):
        """Ratios x/u of masses in a row, the last link to the base, at all frequencies; checked by state space."""
        for ratio in ratios:
            own = sqrt(mpf(2)) if ratio == "sqrt2" else mpf(ratio)
            w = case.param(f"r-{ratio}.omega", float(own * omega))
            Q = [relaxance(1j * w) for relaxance in relaxances]
            n = len(masses)
            A, b = matrix(n, n), matrix(n, 1)
            for i in range(n):
                A[i, i] += Q[i] - masses[i] * w * w
                if i + 1 < n:
                    A[i, i + 1] -= Q[i]
                    A[i + 1, i] -= Q[i]
                    A[i + 1, i + 1] += Q[i]
            b[n - 1] = Q[n - 1]
            T = lu_solve(A, b)
            for i, other in enumerate(states(w)):
                agree(T[i], other)
                tail = f"-{i + 1}" if n > 1 else ""
                case.give(f"r-{ratio}.transmissibility{tail}", abs(T[i]))
                case.give(f"r-{ratio}.phase{tail}", atan2(T[i].imag, T[i].real))
            case.give(f"r-{ratio}.deformation-ratio", abs(T[n - 1] - 1))

    def steady(mode, w, given, outputs):
        """Amplitudes of outputs of z' = A z + b exp(iwt), as 2n real equations; `given` holds b."""
        n = len(mode.names)
        A, b = matrix(2 * n, 2 * n), matrix(2 * n, 1)
        for i, row in enumerate(mode.rows):
            for j, factor in row:
                A[i, j] -= factor
                A[n + i, n + j] -= factor
            A[i, n + i] -= w
            A[n + i, i] += w
            own = given(mode.names[i])
            b[i], b[n + i] = own.real, own.imag
        z = lu_solve(A, b)
        return [mpc(z[mode.names.index(o)], z[n + mode.names.index(o)]) for o in outputs]

    for zeta, C in (("0.1", 200), ("0.5", 1000)):
        case = Case(f"transmissibility-kv-zeta-{zeta}")
        case.params(m=5, K=2e5)
        C = case.param("C", C)
        x, v = unknowns("x v")
        mode = Mode({"x": v, "v": -(K * x + C * v) / m})
        given = lambda w: lambda name: (K + 1j * w * C) / m if name == "v" else mpc(0)
        chain(case, [m], [lambda s: K + C * s], lambda w: steady(mode, w, given(w), ["x"]), K)
        damping = C / (2 * sqrt(K * m))
        formula = lambda r: sqrt((1 + (2 * damping * r) ** 2) / ((1 - r * r) ** 2 + (2 * damping * r) ** 2))
        for line in [own.split(",") for own in lines if own.startswith(case.name + ",r-")]:
            if line[1].endswith(".transmissibility"):
                r = line[1][2:].removesuffix(".transmissibility")
                agree(mpf(line[2]), formula(sqrt(mpf(2)) if r == "sqrt2" else mpf(r)), "1e-14")
        # The largest value, from the derivative of the formula by r^2.
        root = sqrt(1 + 8 * damping**2)
        best = sqrt(root - 1) / (2 * damping)
        agree(mp.diff(formula, best), 0, "1e-12", 1)
        case.give("largest.omega", best * omega)
        case.give("largest.transmissibility", formula(best))

    case = Case("transmissibility-maxwell")
    case.params(m=5, K=2e5)
    C = case.param("C", 2000)
    x, v, u = unknowns("x v u")
    # The deformation of the spring: u' = v - base' - K u/C.
    mode = Mode({"x": v, "v": -K / m * u, "u": v - K / C * u})
    given = lambda w: lambda name: -1j * w if name == "u" else mpc(0)
    chain(case, [m], [lambda s: K * C * s / (K + C * s)], lambda w: steady(mode, w, given(w), ["x"]), K)

    case = Case("transmissibility-zener")
    case.params(m=5)
    K0, K1, C1 = case.params(K0=2e5, K1=4e5, C1=800)
    mode = Mode({"x": v, "v": -(K0 * x + K1 * u) / m, "u": v - K1 / C1 * u})
    given = lambda w: lambda name: {"u": -1j * w, "v": mpc(K0 / m), "x": mpc(0)}[name]
    chain(case, [m], [lambda s: K0 + K1 * C1 * s / (K1 + C1 * s)], lambda w: steady(mode, w, given(w), ["x"]), K)

    case = Case("transmissibility-two-masses")
    m1, K1, C1, m2, K2, C2 = case.params(m1=5, K1=2e5, C1=200, m2=2, K2=4e5, C2=100)
    x1, v1, x2, v2 = unknowns("x1 v1 x2 v2")
    top = K1 * (x1 - x2) + C1 * (v1 - v2)
    mode = Mode({"x1": v1, "v1": -top / m1, "x2": v2, "v2": (top - K2 * x2 - C2 * v2) / m2})
    given = lambda w: lambda name: (K2 + 1j * w * C2) / m2 if name == "v2" else mpc(0)
    relaxances = [lambda s: K1 + C1 * s, lambda s: K2 + C2 * s]
    chain(case, [m1, m2], relaxances, lambda w: steady(mode, w, given(w), ["x1", "x2"]), K)


# 11. Nonlinear laws. The first method is closed or a quadrature, the second one Gauss-Legendre integration.


def smooth(f, low, high, pieces=4):
    """Integral of an analytic function, by Gauss-Legendre, with the error estimated and checked."""
    points = [low + (high - low) * k / pieces for k in range(pieces + 1)]
    result, error = quad(f, points, method="gauss-legendre", maxdegree=8, error=True)
    assert error <= mpf(10) ** -28 * abs(result), nstr(error, 3)
    return result


def cubic_spring(gauss):
    case = Case("cubic-spring")
    m, V, k1, k3 = case.params(m=5, V=4, k1=1e5, k3=2e9)
    deepest = sqrt((sqrt(k1**2 + 2 * k3 * m * V**2) - k1) / k3)
    omega = sqrt((k1 + k3 * deepest**2) / m)
    quarter = ellipk(k3 * deepest**2 / (2 * (k1 + k3 * deepest**2))) / omega
    # y = deepest sin a takes the singularity out of dt = dy/v.
    other = smooth(lambda a: 1 / sqrt((k1 + k3 * deepest**2 * (1 + sin(a) ** 2) / 2) / m), mpf(0), pi / 2)
    agree(quarter, other, "1e-28")
    rate = lambda t, z: [z[1], -(k1 * z[0] + k3 * z[0] ** 3) / m]
    end = gauss.over(rate, mpf(0), [mpf(0), V], quarter, 40)
    agree(end[0], deepest, "1e-28")
    agree(end[1], 0, "1e-28", V)
    case.give("peak-deformation", deepest)
    case.give("peak-deformation.time", quarter)
    case.give("peak-force", k1 * deepest + k3 * deepest**3)
    case.give("release.time", 2 * quarter)
    case.give("release.velocity", -V)
    for fraction in ("0.25", "0.5"):
        time = quarter * mpf(fraction)
        z = gauss.over(rate, mpf(0), [mpf(0), V], time, 20)
        agree(m * z[1] ** 2 / 2 + k1 * z[0] ** 2 / 2 + k3 * z[0] ** 4 / 4, m * V**2 / 2)
        case.give(f"at-{fraction}-of-peak-time.position", z[0])
        case.give(f"at-{fraction}-of-peak-time.velocity", z[1])

    case = Case("pure-cubic-spring")
    m, V, k3 = case.params(m=5, V=4, k3=2e9)
    deepest = (2 * m * V**2 / k3) ** (mpf(1) / 4)
    # Quarter period: deepest/V times the integral of 1/sqrt(1 - u^4).
    quarter = deepest / V * beta(mpf(1) / 4, mpf(1) / 2) / 4
    agree(quarter, deepest / V * smooth(lambda a: 1 / sqrt(1 + sin(a) ** 2), mpf(0), pi / 2), "1e-28")
    end = gauss.over(lambda t, z: [z[1], -k3 / m * z[0] ** 3], mpf(0), [mpf(0), V], quarter, 40)
    agree(end[0], deepest, "1e-28")
    agree(end[1], 0, "1e-28", V)
    case.give("peak-deformation", deepest)
    case.give("peak-deformation.time", quarter)
    case.give("peak-force", k3 * deepest**3)
    case.give("release.time", 2 * quarter)
    case.give("period", 4 * quarter)


def hertz(gauss):
    for p in (1.5, 2, 3.5):
        case = Case(f"power-spring-{p}")
        m, V, k, p = case.params(m=5, V=4, k=1e8 if p == 1.5 else 1e9 if p == 2 else 1e13, p=p)
        deepest = ((p + 1) * m * V**2 / (2 * k)) ** (1 / (p + 1))
        duration = 2 * deepest / V * sqrt(pi) * gamma(1 + 1 / (p + 1)) / gamma(mpf(1) / 2 + 1 / (p + 1))
        case.give("peak-deformation", deepest)
        case.give("peak-force", k * deepest**p)
        case.give("peak-deformation.time", duration / 2)
        case.give("release.time", duration)
        case.give("release.velocity", -V)
        case.give("impulse", 2 * m * V)
        if p == mpf("1.5"):
            agree(duration / (m**2 / (k**2 * V)) ** (mpf(1) / 5), mpf("3.218"), "1e-4")
        # With t = s^2 the motion is analytic in s from the touch on.
        rate = lambda s, z: [2 * s * z[1], -2 * s * k / m * z[0] ** p]
        end = gauss.over(rate, mpf(0), [mpf(0), V], sqrt(duration / 2), 60)
        agree(end[0], deepest, "1e-24")
        agree(end[1], 0, "1e-24", V)


def hunt_crossley(gauss):
    """F = k y^n (1 + c y'). With G(v) = v/c - ln(1 + c v)/c^2 the sum m G(v) + k y^(n+1)/(n+1) is constant."""
    for name, c in (("0.2", 0.05), ("1", 0.25), ("5", 1.25), ("50", 12.5)):
        case = Case(f"hunt-crossley-d-{name}")
        m, V, k, n, c = case.params(m=5, V=4, k=1e8, n=1.5, c=c)
        d = c * V
        case.give("d", d)
        # d (1 + e) = ln((1 + d)/(1 - e d)), by Lambert's W: 1 - e d = -W0(-(1 + d) exp(-(1 + d))).
        with mp.workdps(80):
            e = (1 + lambertw(-(1 + d) * exp(-(1 + d))).real) / d
            agree(d * (1 + e), log((1 + d) / (1 - e * d)))
        work = (d - log1p(d)) / c**2
        deepest = ((n + 1) * m * work / k) ** (1 / (n + 1))
        case.give("restitution", e)
        case.give("release.velocity", -e * V)
        case.give("peak-deformation", deepest)
        case.give("dissipated", m * V**2 * (1 - e * e) / 2)

        def squeezed(delta, start):
            """Deformation when the velocity is off by `delta` from that at the touch or release (`start`)."""
            there = log1p(-c * delta / (1 + c * start)) + c * delta
            return ((n + 1) * m * there / (k * c * c)) ** (1 / (n + 1))

        def passing(start, change):
            """Time in which the velocity changes from `start` by `change`; y is analytic in s, delta = change s^5."""

            def integrand(s):
                delta = change * s**5
                y = squeezed(delta, start)
                return 5 * s**4 * abs(change) * m / (k * y**n * (1 + c * (start - delta)))

            return smooth(integrand, mpf(0), mpf(1), 8)

        # At d = 50 the mass leaves so close to its limit speed 1/c that only the second integral is accurate.
        down = passing(V, V)
        up = passing(-e * V, -e * V) if name != "50" else None

        def lambert_time(branch, first=mpf(0)):
            """The same by deformation, from y = deepest (1 - first^2) to 0: dt = dy/v, v from Lambert's W."""

            def integrand(s):
                # y = deepest (1 - s^2) takes away the singularity at the largest deformation.
                left = work * -mp.expm1((n + 1) * log(1 - s * s)) * c * c
                # w - ln(1 + w) = left, on the branch w > 0 or w < 0.
                w = lambertw(-exp(-1 - left), branch).real
                speed = abs(-w - 1) / c
                return 2 * deepest * s / speed

            with mp.workdps(80):
                return quad(integrand, [first, (1 + first) / 2, mpf(1)])

        agree(down, lambert_time(-1), "1e-22")
        by_lambert = lambert_time(0)
        if up is None:
            up = by_lambert
        else:
            agree(up, by_lambert, "1e-22")
        case.give("peak-deformation.time", down)
        case.give("release.time", down + up)
        # Largest force: n v = c (n + 1) (G(v0) - G(v)), G(v) = v/c - ln(1 + c v)/c^2.
        rest = lambda v: work - (v / c - log1p(c * v) / c**2)
        most = findroot(lambda v: n * v - c * (n + 1) * rest(v), (mpf(0), V), solver="anderson", tol=mpf(10) ** -80)
        y = ((n + 1) * m * rest(most) / k) ** (1 / (n + 1))
        force = k * y**n * (1 + c * most)
        case.give("peak-force", force)
        case.give("peak-force.velocity", most)
        case.give("peak-force.deformation", y)
        nearby = [k * ((n + 1) * m * rest(v) / k) ** (n / (n + 1)) * (1 + c * v) for v in (most * 0.999, most * 1.001)]
        assert max(nearby) < force
        case.give("peak-force.time", passing(V, V - most))
        # Second way: the equation of motion, forward from the touch and backward from the release, in s = sqrt t.
        rate = lambda s, z: [2 * s * z[1], -2 * s * k / m * z[0] ** n * (1 + c * z[1])]
        end = gauss.over(rate, mpf(0), [mpf(0), V], sqrt(down), 60)
        agree(end[0], deepest, "1e-22")
        agree(end[1], 0, "1e-22", V)
        backward = lambda s, z: [-2 * s * z[1], 2 * s * k / m * z[0] ** n * (1 + c * z[1])]
        if name == "50":
            # The release is passed too closely to go back from it: half of the way out, and the rest by Lambert's W.
            rate = lambda t, z: [z[1], -k / m * z[0] ** n * (1 + c * z[1])]
            half = gauss.over(rate, mpf(0), [deepest, mpf(0)], up / 2, 400)
            agree(lambert_time(0, sqrt(1 - half[0] / deepest)), up / 2, "1e-20")
        else:
            end = gauss.over(backward, mpf(0), [mpf(0), -e * V], sqrt(up), 80)
            agree(end[0], deepest, "1e-22")
            agree(end[1], 0, "1e-22", V)


def power_dashpots(gauss):
    for name, m, c, V in (("unit", 1, 1, 1), ("si", 2, 30, 5)):
        case = Case(f"dashpot-power-0.5-{name}")
        m, c, V = case.params(m=m, c=c, V=V)
        stop = 2 * m * sqrt(V) / c
        case.give("stop.time", stop)
        case.give("stop.position", 2 * m * V ** mpf(1.5) / (3 * c))
        case.give("dissipated", m * V**2 / 2)
        half = stop / 2
        case.give("half-time.time", half)
        case.give("half-time.velocity", V / 4)
        case.give("half-time.position", 2 * m * V ** mpf(1.5) / (3 * c) * mpf(7) / 8)
        end = gauss.over(lambda t, z: [z[1], -c / m * sqrt(z[1])], mpf(0), [mpf(0), V], half, 20)
        agree(end[0], 2 * m * V ** mpf(1.5) / (3 * c) * mpf(7) / 8, "1e-25")
        agree(end[1], V / 4, "1e-25")

        case = Case(f"dashpot-power-2-{name}")
        m, c, V = case.params(m=m, c=c, V=V)
        for number, own in enumerate((0.01, 0.1, 1.0), 1):
            t = case.param(f"time-{number}", own)
            growth = 1 + c * V * t / m
            case.give(f"time-{number}.velocity", V / growth)
            case.give(f"time-{number}.position", m / c * log(growth))
            steps = int(20 + 4 * growth)
            end = gauss.over(lambda t, z: [z[1], -c / m * z[1] ** 2], mpf(0), [mpf(0), V], t, steps)
            agree(end[0], m / c * log(growth), "1e-20")

    # A spring beside a square dashpot, with separation at zero force.
    case = Case("spring-and-dashpot-power-2")
    m, V, K, c = case.params(m=5, V=4, K=2e5, c=200)
    rate = lambda t, z: [z[1], -(K * z[0] + c * z[1] * abs(z[1])) / m]
    top_time, top = gauss.until(rate, mpf(0), [mpf(0), V], mpf("0.0005"), lambda z: z[1])
    end_time, end = gauss.until(rate, top_time, [top[0], mpf(0)], mpf("0.0005"), lambda z: K * z[0] - c * z[1] ** 2)
    # In closed form v^2 is linear in y: on the way in v^2 = (V^2 - b) exp(-a y) + b - 2 K y/(a m), b = 2 K/(a^2 m).
    a = 2 * c / m
    b = 2 * K / (a * a * m)
    inward = lambda y: (V**2 - b) * exp(-a * y) + b - 2 * K * y / (a * m)
    deepest = findroot(inward, (top[0], top[0] * 1.001), tol=mpf(10) ** -70)
    agree(deepest, top[0], "1e-26")
    # On the way out, v^2 = A exp(a y) + b + 2 K y/(a m) with v = 0 at the top; it ends where K y = c v^2.
    factor = -(b + 2 * K * deepest / (a * m)) * exp(-a * deepest)
    outward = lambda y: factor * exp(a * y) + b + 2 * K * y / (a * m)
    place = findroot(lambda y: K * y - c * outward(y), (end[0], end[0] * 1.001), tol=mpf(10) ** -70)
    agree(place, end[0], "1e-26")
    agree(sqrt(outward(place)), -end[1], "1e-26")
    case.give("peak-deformation", deepest)
    case.give("peak-deformation.time", top_time)
    case.give("release.time", end_time)
    case.give("release.velocity", -sqrt(outward(place)))
    case.give("release.deformation", place)
    case.give("restitution", sqrt(outward(place)) / V)
    case.give("force-at-touch", c * V**2)

    # A spring and a square-root dashpot (F = c sqrt v) in a row, with separation: u' = v - (K u/c)^2.
    case = Case("spring-dashpot-power-0.5-in-series")
    m, V, K, c = case.params(m=5, V=4, K=2e5, c=2000)
    rate = lambda t, z: [z[1] - (K * z[0] / c) ** 2, -K / m * z[0], (K * z[0] / c) ** 2, K * z[0] * (K * z[0] / c) ** 2]
    zero = mpf(0)
    start, h = [zero, V, zero, zero], mpf("0.0004")
    end_time, end = gauss.until(rate, zero, start, h, lambda z: z[0])
    agree(m * V**2 / 2, m * end[1] ** 2 / 2 + end[3], "1e-28")
    peak_time, there = gauss.until(rate, zero, start, h, lambda z: z[1] - (K * z[0] / c) ** 2)
    case.give("peak-force", K * there[0])
    case.give("peak-force.time", peak_time)
    deep_time, deep = gauss.until(rate, zero, start, h, lambda z: z[1])
    case.give("peak-deformation", deep[0] + deep[2])
    case.give("peak-deformation.time", deep_time)
    case.give("release.time", end_time)
    case.give("release.velocity", end[1])
    case.give("release.deformation", end[2])
    case.give("dissipated", end[3])
    # Second way, besides the energy above: steps of another length.
    again = gauss.over(rate, zero, start, end_time, 97)
    agree(again[1], end[1], "1e-28")
    agree(again[2], end[2], "1e-28")


def springs_in_series(gauss):
    """F = k1 y1^3 = k2 y2 + k3 y2^3 with a joint without mass between; the deformation y2 tells all."""
    case = Case("springs-in-series")
    m, V, k1, k2, k3 = case.params(m=5, V=4, k1=5e9, k2=2e5, k3=3e9)
    force = lambda y: k2 * y + k3 * y**3
    first = lambda y: (force(y) / k1) ** (mpf(1) / 3)
    stored = lambda y: k1 * first(y) ** 4 / 4 + k2 * y**2 / 2 + k3 * y**4 / 4
    energy = m * V**2 / 2
    y2 = findroot(lambda y: stored(y) - energy, (mpf("0.001"), mpf("0.02")), solver="anderson", tol=mpf(10) ** -80)
    y1 = first(y2)
    # In the cube root a, y1 = a, force = k1 a^3, everything is analytic: dt = (1 + dy2/da) da/v.
    second = lambda a: findroot(lambda y: force(y) - k1 * a**3, k1 * a**3 / (k2 + k3 * y2**2))

    def integrand(s):
        a = y1 * (1 - s * s)
        y = second(a)
        left = energy - (k1 * a**4 / 4 + k2 * y**2 / 2 + k3 * y**4 / 4)
        return 2 * y1 * s * (1 + 3 * k1 * a * a / (k2 + 3 * k3 * y * y)) / sqrt(2 * left / m)

    time = smooth(integrand, mpf(0), mpf(1), 4)
    case.give("peak-deformation", y1 + y2)
    case.give("peak-deformation.time", time)
    case.give("peak-deformation.of-cubic", y1)
    case.give("peak-deformation.of-stiffening", y2)
    case.give("peak-force", force(y2))
    case.give("release.time", 2 * time)
    case.give("release.velocity", -V)

    # Second way: the motion; the deformation y1 has the rate v/(1 + dy2/dy1).
    def rate(t, z):
        a, y, v = z
        share = 3 * k1 * a * a / (k2 + 3 * k3 * y * y)
        return [v / (1 + share), v * share / (1 + share), -k1 / m * a**3]

    end = gauss.over(rate, mpf(0), [mpf(0), mpf(0), V], time, 60)
    agree(end[0], y1, "1e-22")
    agree(end[1], y2, "1e-22")
    agree(end[2], 0, "1e-22", V)


def rate_law(gauss):
    """F = k y (1 + a ln(1 + y'/v_ref)) while y' > 0, and k y on the way back."""
    case = Case("rate-law")
    m, V, k, a, v_ref = case.params(m=5, V=4, k=1e5, a=0.2, v_ref=0.05)
    factor = lambda v: 1 + a * log1p(v / v_ref)
    # Loading separates: k y^2/(2 m) = integral of v/(1 + phi(v)). v = v_ref (exp(z) - 1) makes it smooth.
    top = log1p(V / v_ref)
    half = smooth(lambda z: v_ref**2 * mp.expm1(z) * exp(z) / (1 + a * z), mpf(0), top)
    deepest = sqrt(2 * m * half / k)
    rate = lambda t, z: [z[1], -k / m * z[0] * factor(z[1])]
    time, end = gauss.until(rate, mpf(0), [mpf(0), V], mpf("0.0001"), lambda z: z[1])
    agree(end[0], deepest, "1e-26")
    # Where the force is largest: y factor(v) with its rate zero.
    rise = lambda z: z[1] * factor(z[1]) - z[0] * a / (v_ref + z[1]) * k / m * z[0] * factor(z[1])
    peak_time, there = gauss.until(rate, mpf(0), [mpf(0), V], mpf("0.0001"), rise)
    omega = sqrt(k / m)
    case.give("peak-deformation", deepest)
    case.give("peak-deformation.time", time)
    case.give("peak-force", k * there[0] * factor(there[1]))
    case.give("peak-force.time", peak_time)
    case.give("force-at-peak-deformation", k * deepest)
    case.give("release.time", time + pi / (2 * omega))
    case.give("release.velocity", -omega * deepest)
    case.give("restitution", omega * deepest / V)
    case.give("energy-returned", k * deepest**2 / 2)
    case.give("dissipated", m * V**2 / 2 - k * deepest**2 / 2)


# 12. Steady answers to a sine force.


def steady_force(gauss):
    case = Case("steady-kv")
    m, K, C, P = case.params(m=5, K=2e5, C=600, P=2000)
    omega = sqrt(K / m)
    damping = C / (2 * sqrt(K * m))
    for ratio in ("0.1", "0.5", "1", "2", "10"):
        w = case.param(f"r-{ratio}.omega", float(mpf(ratio) * omega))
        r = w / omega
        amplitude = P / K / sqrt((1 - r * r) ** 2 + (2 * damping * r) ** 2)
        lag = atan2(2 * damping * r, 1 - r * r)
        case.give(f"r-{ratio}.amplitude", amplitude)
        case.give(f"r-{ratio}.lag", lag)
        case.give(f"r-{ratio}.pad-force-amplitude", amplitude * sqrt(K**2 + (C * w) ** 2))
        case.give(f"r-{ratio}.power", C * (w * amplitude) ** 2 / 2)
        agree(amplitude, abs(P / (K - m * w * w + 1j * C * w)))
        # The force's power is what the dashpot takes.
        agree(P * w * amplitude * sin(lag) / 2, C * (w * amplitude) ** 2 / 2)

    # Hardening spring: m x'' + C x' + k1 x + k3 x^3 = P sin(w t), odd harmonics by Newton's method.
    case = Case("steady-duffing")
    m, C, k1, k3, P, w = case.params(m=5, C=600, k1=2e5, k3=1e9, P=2000, omega=150)
    n = 24
    # Unknowns: sine and cosine amplitudes of the harmonics 1, 3, …; collocation over half a period.
    angles = [pi * i / (2 * n) for i in range(2 * n)]
    basis = [[f((2 * j + 1) * a) for j in range(n) for f in (sin, cos)] for a in angles]
    linear = []
    for a in angles:
        row = []
        for j in range(n):
            o = (2 * j + 1) * w
            s, c = sin((2 * j + 1) * a), cos((2 * j + 1) * a)
            row += [(k1 - m * o * o) * s + C * o * c, (k1 - m * o * o) * c - C * o * s]
        linear.append(row)
    first = P / (k1 - m * w * w + 1j * C * w)
    z = matrix([first.real, first.imag] + [0] * (2 * n - 2))
    for _ in range(40):
        xs = [sum(b * own for b, own in zip(row, z)) for row in basis]
        rest = matrix(
            [
                sum(b * own for b, own in zip(row, z)) + k3 * x**3 - P * sin(a)
                for row, x, a in zip(linear, xs, angles)
            ]
        )
        J = matrix(2 * n, 2 * n)
        for i in range(2 * n):
            for j in range(2 * n):
                J[i, j] = linear[i][j] + 3 * k3 * xs[i] ** 2 * basis[i][j]
        change = lu_solve(J, rest)
        z -= change
        if max(abs(own) for own in change) < mpf(10) ** -40:
            break
    else:
        raise ArithmeticError("no convergence")
    assert abs(z[2 * n - 1]) + abs(z[2 * n - 2]) < mpf(10) ** -24 * abs(first)
    place = lambda t: sum(
        z[2 * j] * sin((2 * j + 1) * w * t) + z[2 * j + 1] * cos((2 * j + 1) * w * t) for j in range(n)
    )
    speed = lambda t: sum(
        (2 * j + 1) * w * (z[2 * j] * cos((2 * j + 1) * w * t) - z[2 * j + 1] * sin((2 * j + 1) * w * t))
        for j in range(n)
    )
    # Second way: half a period of the motion turns the state around.
    rate = lambda t, q: [q[1], (P * sin(w * t) - C * q[1] - k1 * q[0] - k3 * q[0] ** 3) / m]
    end = gauss.over(rate, mpf(0), [place(mpf(0)), speed(mpf(0))], pi / w, 60)
    agree(end[0], -place(mpf(0)), "1e-20", abs(first))
    agree(end[1], -speed(mpf(0)), "1e-20", abs(first) * w)
    # The largest place, near the top of the first harmonic.
    guess = atan2(z[0], z[1]) / w
    top = findroot(speed, (guess, guess * 1.001), tol=mpf(10) ** -70)
    assert all(abs(place(pi / w * i / 200)) <= abs(place(top)) for i in range(200))
    case.give("amplitude", abs(place(top)))
    case.give("phase-time-of-maximum", top % (2 * pi / w))
    case.give("harmonic-1.sine", z[0])
    case.give("harmonic-1.cosine", z[1])
    case.give("harmonic-3.sine", z[2])
    case.give("harmonic-3.cosine", z[3])
    case.give("period-start.position", place(mpf(0)))
    case.give("period-start.velocity", speed(mpf(0)))


# 13. Swept sines. The first method is closed or the convolution with the impulse response by quadrature, the
# second one Gauss-Legendre integration of the equation of motion.


class Chirp:
    """A sine of the frequency f0 at `start`, that of f1 from `length` later on, and linear between; and its rate."""

    def __init__(self, amplitude, f0, f1, length, start):
        self.amplitude, self.start, self.length = amplitude, start, length
        self.end = start + length
        self.omega, self.sweep = 2 * pi * f0, 2 * pi * (f1 - f0) / length
        self.last = 2 * pi * f1
        self.turned = (self.omega + self.sweep * length / 2) * length

    def parts(self, t):
        """Phase and its rate."""
        s = t - self.start
        if t <= self.end:
            return (self.omega + self.sweep * s / 2) * s, self.omega + self.sweep * s
        return self.turned + self.last * (t - self.end), self.last

    def value(self, t):
        return self.amplitude * sin(self.parts(t)[0])

    def rate(self, t):
        phase, rate = self.parts(t)
        return self.amplitude * rate * cos(phase)

    def spans(self, t):
        """The parts of the time from the start to t on which it is analytic."""
        return [(self.start, min(t, self.end))] + ([(self.end, t)] if t > self.end else [])


def swept_integral(chirp, t):
    """Integral of a rising chirp from its start to t, which is within the sweep: Fresnel's integrals."""
    # The phase is sweep (s + b)^2/2 - sweep b^2/2, with the arguments of Fresnel's integrals z = (s + b) sqrt(sweep/pi).
    b = chirp.omega / chirp.sweep
    scale = sqrt(pi / chirp.sweep)
    low, high = b / scale, (t - chirp.start + b) / scale
    back = chirp.sweep * b * b / 2
    sines, cosines = fresnels(high) - fresnels(low), fresnelc(high) - fresnelc(low)
    return chirp.amplitude * scale * (sines * cos(back) - cosines * sin(back))


def chirps(gauss):
    times = {"sweep": "0.3", "end": None, "after": "0.7"}

    def chirp_of(case, amplitude):
        f0, f1, length, start = case.params(f0=2, f1=40, length=0.5, start=0.0625)
        chirp = Chirp(amplitude, f0, f1, length, start)
        return chirp, [(name, chirp.end if own is None else case.param(f"{name}.time", own)) for name, own in times.items()]

    # A free mass: its speed is the integral of the force over the mass.
    case = Case("chirp-free")
    m, P = case.params(m=5, P=100)
    chirp, instants = chirp_of(case, P)
    for name, t in instants:
        speed = swept_integral(chirp, min(t, chirp.end)) / m
        if t > chirp.end:
            turned = cos(chirp.turned) - cos(chirp.turned + chirp.last * (t - chirp.end))
            speed += P / m * turned / chirp.last
        agree(speed, sum(smooth(chirp.value, *span, 32) for span in chirp.spans(t)) / m, "1e-28", P / m * t)
        place = sum(smooth(lambda s: (t - s) * chirp.value(s), *span, 32) for span in chirp.spans(t)) / m
        case.give(f"{name}.velocity", speed)
        case.give(f"{name}.position", place)

    # A mass on a pad, by a force and by a motion of the ground; the sweep passes the resonance.
    for way in ("force", "motion"):
        case = Case(f"chirp-{way}")
        m, K, C, P = case.params(m=5, K=2e5, C=100, P=100 if way == "force" else 0.001)
        chirp, instants = chirp_of(case, P)
        push = chirp.value if way == "force" else lambda t: K * chirp.value(t) + C * chirp.rate(t)
        decay = C / (2 * m)
        w = sqrt(K / m - decay**2)
        answer = lambda t: exp(-decay * t) * sin(w * t) / (m * w)
        rate_of = lambda t: exp(-decay * t) * (cos(w * t) - decay / w * sin(w * t)) / m
        motion = lambda t, z: [z[1], (push(t) - K * z[0] - C * z[1]) / m]
        state, at = [mpf(0), mpf(0)], chirp.start
        for name, t in instants:
            place = sum(smooth(lambda s: answer(t - s) * push(s), *span, 32) for span in chirp.spans(t))
            speed = sum(smooth(lambda s: rate_of(t - s) * push(s), *span, 32) for span in chirp.spans(t))
            state, at = gauss.over(motion, at, state, t, 60), t
            agree(state[0], place, "1e-24", 1 / w)
            agree(state[1], speed, "1e-24", 1)
            case.give(f"{name}.position", place)
            case.give(f"{name}.velocity", speed)


def main():
    kelvin_voigt()
    kelvin_voigt_gravity()
    kelvin_voigt_bouncing()
    maxwell()
    zener()
    burgers()
    rigid_stop()
    stop_chatter()
    stiff_stop()
    bounce_rigid()
    bounce_spring()
    face_plastic()
    face_restitution()
    two_interfaces()
    belt()
    slider()
    slider_driven()
    slider_in_series()
    bar()
    transmissibility()
    gauss = Gauss()
    with mp.workdps(40):
        cubic_spring(gauss)
        hertz(gauss)
        hunt_crossley(gauss)
        power_dashpots(gauss)
        springs_in_series(gauss)
        rate_law(gauss)
        steady_force(gauss)
        chirps(gauss)
    header = [
        "# Reference solutions of the effects. Regenerate: python3 effects_reference.py (needs mpmath).",
        "# Conventions and methods stand at the head of that script. SI units; param.* are inputs.",
        "case,quantity,value",
    ]
    names = [tuple(line.split(",")[:2]) for line in lines]
    assert len(set(names)) == len(names), "a quantity is given twice"
    Path(__file__).with_suffix(".csv").write_text("\n".join(header + lines) + "\n")


if __name__ == "__main__":
    main()
