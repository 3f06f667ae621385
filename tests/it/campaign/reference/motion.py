"""The motion of a network, event by event.

A body with mass has its acceleration as unknown, one without its rate: the balance 0 = sum of forces, in which that
rate may occur or not. Between two events these equations are smooth, and are solved by Radau's collocation; a step
ends where a phase does.
"""

import numpy as np

from bodies import Mode, Unfit
from collocation import Radau
from switching import Step, Switching


class Solver(Switching):
    def __init__(self, network, stages=8, tolerance=1e-11):
        self.network, self.radau, self.tolerance = network, Radau(stages), tolerance
        self.steps, self.struck, self.events = [], set(), 0
        waves = [n.motion for n in network.nodes if n.motion is not None]
        waves += [own for n in network.nodes for own in n.loads]
        self.waves = waves
        self.ia = np.array([own.a for own in network.links])
        self.ib = np.array([own.b for own in network.links])

    # Forces

    def loads(self, n, t, when):
        node = self.network.nodes[n]
        total = node.mass * self.network.gravity + 0 * t
        for own in node.loads:
            total = total + own.at(t, when)[0]
        return total

    def places(self, mode, t, when, X, W):
        """Places and rates of all nodes from those of the free bodies, each an array over times."""
        x, w = np.empty((len(self.network.nodes), len(t))), np.empty((len(self.network.nodes), len(t)))
        given = {}
        for n, b in enumerate(mode.body):
            i = mode.map[n]
            if i >= 0:
                x[n], w[n] = X[i] + mode.offset[n], W[i]
            else:
                if b not in given:
                    g = mode.given[b]
                    given[b] = (self.network.nodes[g].motion.at(t, when), mode.offset[g])
                (u, du, _), own = given[b]
                x[n], w[n] = u + mode.offset[n] - own, du
        return x, w

    def residual(self, mode, t, when, X, W, Acc):
        """Lack of balance of the free bodies, and its slopes over places and rates."""
        n = len(mode.free)
        x, w = self.places(mode, t, when, X, W)
        y, rate = x[self.ia] - x[self.ib], w[self.ia] - w[self.ib]
        R = np.zeros((n, len(t)))
        K, C = np.zeros((len(t), n, n)), np.zeros((len(t), n, n))
        for node, i in enumerate(mode.map):
            if i >= 0:
                R[i] -= self.loads(node, t, when)
        R += mode.masses[:, None] * np.where(mode.heavy[:, None], Acc, 0.0)
        size = np.abs(R)
        for at in mode.laws:
            F, k, c = self.network.links[at].part.law(mode.phases[at], y[at], rate[at])
            i, j = mode.map[self.ia[at]], mode.map[self.ib[at]]
            for row, sign in ((i, 1), (j, -1)):
                if row < 0:
                    continue
                R[row] += sign * F
                size[row] += np.abs(F)
                for column, other in ((i, 1), (j, -1)):
                    if column >= 0:
                        K[:, row, column] += sign * other * k
                        C[:, row, column] += sign * other * c
        return R, K, C, size

    # Steps

    def start_of(self, mode, x, v):
        X = np.array([x[mode.root[b]] - mode.offset[mode.root[b]] for b in mode.free])
        V = np.array([v[mode.root[b]] if mode.mass[b] > 0 else 0.0 for b in mode.free])
        return X, V

    def stages(self, mode, h, X, V, c, B1, B2, u, B0=None):
        """Places, rates and accelerations where the polynomials are given."""
        heavy = mode.heavy[:, None]
        once, twice = u @ B1.T, u @ B2.T
        values = u if B0 is None else u @ B0.T
        place = X[:, None] + np.where(heavy, h * c[None] * V[:, None] + h * h * twice, h * once)
        rate = np.where(heavy, V[:, None] + h * once, values)
        return place, rate, values

    def step(self, mode, t, h, X, V):
        """The stages of a step, or None where Newton's method fails."""
        r = self.radau
        s, n = r.s, len(mode.free)
        if n == 0:
            return np.zeros((0, s))
        times, when = t + h * r.c, t + h / 2
        u = np.zeros((n, s))
        # Places are known to their rounding, and rates of what is massless to that over the step.
        last, rounding = np.inf, 1e-11 + 1e-11 * self.length / (h * self.speed)
        for turn in range(30):
            place, rate, acc = self.stages(mode, h, X, V, r.c, r.A, r.AA, u)
            R, K, C, size = self.residual(mode, times, when, place, rate, acc)
            J = np.zeros((n, s, n, s))
            for i in range(n):
                for j in range(n):
                    if mode.heavy[j]:
                        J[i, :, j, :] = h * h * K[:, i, j][:, None] * r.AA + h * C[:, i, j][:, None] * r.A
                    else:
                        J[i, :, j, :] = h * K[:, i, j][:, None] * r.A + np.diag(C[:, i, j])
                if mode.heavy[i]:
                    J[i, :, i, :] += mode.masses[i] * np.eye(s)
            J = J.reshape(n * s, n * s)
            rows = np.abs(J).max(axis=1)
            columns = np.abs(J / np.maximum(rows, 1e-300)[:, None]).max(axis=0)
            if not np.all(np.isfinite(J)) or rows.min() == 0 or columns.min() == 0:
                return None
            try:
                d = np.linalg.solve(J / rows[:, None] / columns[None], -R.reshape(-1) / rows) / columns
            except np.linalg.LinAlgError:
                return None
            u = u + d.reshape(n, s)
            scale = np.maximum(
                np.abs(u).max(axis=1), 1e-3 * self.speed * np.where(mode.heavy, self.speed / self.length, 1.0)
            )
            change = float((np.abs(d.reshape(n, s)).max(axis=1) / scale).max())
            if not np.isfinite(change):
                return None
            if change < 1e-14 or (change < rounding and change > 0.3 * last):
                return u
            if turn > 8 and change > 0.9 * last:
                return None
            last = change
        return None

    def error(self, mode, h, u):
        """The last coefficients of the stages' polynomials, in parts of the speeds."""
        if not len(u):
            return 0.0
        coefficients = u @ self.radau.to_coefficients.T
        tail = np.abs(coefficients[:, -2:]).max(axis=1)
        # A rate of what is massless is known no better than its place, in parts of the step.
        tail = np.where(mode.heavy, tail * h, tail * min(1.0, 100 * h * self.speed / self.length))
        return float(tail.max() / self.speed)

    def signals(self, step, theta):
        """x, w of all nodes and F, y, w of all links where the step is at the parts `theta`."""
        mode, r, t, h = step.mode, self.radau, step.t, step.h
        theta = np.asarray(theta, float)
        when = t + h / 2
        X, V = self.start_of(mode, step.x, step.v)
        B0, B1, B2 = r.all(theta)
        place, rate, acc = self.stages(mode, h, X, V, theta, B1, B2, step.u, B0)
        times = t + h * theta
        x, w = self.places(mode, times, when, place, rate)
        y, dy = x[self.ia] - x[self.ib], w[self.ia] - w[self.ib]
        F = np.zeros_like(y)
        for at in mode.laws:
            F[at] = self.network.links[at].part.law(mode.phases[at], y[at], dy[at])[0]
        a = np.zeros_like(x)
        for n, b in enumerate(mode.body):
            if mode.map[n] >= 0:
                a[n] = acc[mode.map[n]] if mode.mass[b] > 0 else 0.0
            else:
                a[n] = self.network.nodes[mode.given[b]].motion.at(times, when)[2]
        if mode.constraints:
            pushed = np.zeros_like(x)
            np.add.at(pushed, self.ia, -F)
            np.add.at(pushed, self.ib, F)
            for at in mode.constraints:
                nodes, is_a = mode.sides[at]
                lack = sum(pushed[n] + self.loads(n, times, when) - self.network.nodes[n].mass * a[n] for n in nodes)
                # Side a feels -F.
                F[at] = lack if is_a else -lack
        return x, w, a, F, y, dy

    # Events

    def guards(self, mode):
        found = []
        for at, (link, phase) in enumerate(zip(self.network.links, mode.phases)):
            for what, sign, level, follower in link.part.ends(phase):
                found.append((at, what, sign, level, follower))
        return found

    def scales(self):
        return {"y": self.length, "w": self.speed, "F": self.force}

    def first_end(self, step, is_fresh):
        """The first guard that falls below zero within the step: its part of the step, and which."""
        guards = self.guards(step.mode)
        if not guards:
            return None
        theta = np.linspace(0, 1, 49)
        _, _, _, F, y, w = self.signals(step, theta)
        values = {"y": y, "w": w, "F": F}
        best = None
        for guard in guards:
            at, what, sign, level, _ = guard
            own = sign * (values[what][at] - level)
            noise = (1e-13 if what == "y" else 1e-11) * self.scales()[what]
            below = own < (-noise if is_fresh else 0)
            # What begins at its level leaves it first: rounding there is no end.
            if is_fresh and abs(own[0]) <= noise:
                risen = np.flatnonzero(own > noise)
                fallen = np.flatnonzero(own < -noise)
                if len(fallen) and (not len(risen) or fallen[0] < risen[0]):
                    return 0.0, guard
                below = np.zeros(len(own), bool)
                if len(risen):
                    below[risen[0] :] = own[risen[0] :] < 0
            hits = np.flatnonzero(below)
            if len(hits):
                k = hits[0]
                if k == 0:
                    if own[0] < -1e3 * noise:
                        raise Unfit(f"{self.network.links[at].name} begins beyond its {what}")
                    root = 0.0
                else:
                    root = self.root(step, guard, theta[k - 1], theta[k])
                if best is None or root < best[0]:
                    best = (root, guard)
            else:
                # A shallow dip between the points.
                k = int(np.argmin(own[1:-1])) + 1
                if (
                    0 < k < len(own) - 1
                    and own[k] < 1e-6 * self.scales()[what]
                    and own[k] <= own[k - 1]
                    and own[k] <= own[k + 1]
                ):
                    fine = np.linspace(theta[k - 1], theta[k + 1], 200)
                    _, _, _, F2, y2, w2 = self.signals(step, fine)
                    dip = sign * ({"y": y2, "w": w2, "F": F2}[what][at] - level)
                    if dip.min() < 1e-9 * self.scales()[what] and own[k] > noise:
                        raise Unfit(f"{self.network.links[at].name} grazes its {what}")
        return best

    def root(self, step, guard, low, high):
        """Where the guard is zero, by the bracketed secant of Illinois on the step's polynomials."""
        at, what, sign, level, _ = guard
        pick = {"F": 3, "y": 4, "w": 5}[what]
        f = lambda s: float(sign * (self.signals(step, np.array([s]))[pick][at][0] - level))
        a, b, fa, fb = low, high, f(low), f(high)
        for _ in range(80):
            if fa == fb or b - a < 1e-16:
                break
            s = (a * fb - b * fa) / (fb - fa)
            fs = f(s)
            if fs == 0:
                return s
            if fs * fb < 0:
                a, fa, b, fb = b, fb, s, fs
            else:
                b, fb, fa = s, fs, fa / 2
            if abs(b - a) < 4e-16:
                break
        return b

    # The run

    def begin(self, length, speed, force, duration):
        """The scales of a run, which tell what is rounding, and its length."""
        self.length, self.speed, self.force, self.duration = length, speed, force, duration

    def run(self, x):
        """Follows the motion from the places `x`; places of driven nodes there do not matter."""
        t, h, is_fresh, repeats = 0.0, 1e-4 * self.duration, True, 0
        x, v, phases = self.first_phases(x)
        mode = Mode(self.network, phases, x)
        breaks = sorted({own for wave in self.waves for own in wave.breaks() if 0 < own < self.duration})
        while t < self.duration:
            if len(self.steps) > 6000 or self.events > 400:
                raise Unfit("too many steps")
            until = min([own for own in breaks if own > t] + [self.duration])
            is_last = h >= until - t
            # The last step before a break is not much shorter than the one before it.
            own = until - t if is_last else min(h, 0.5 * (until - t))
            u = self.step(mode, t, own, *self.start_of(mode, x, v))
            error = self.error(mode, own, u) if u is not None else np.inf
            if error > self.tolerance and own > 1e-13 * self.duration:
                h = own * max(0.2, self.growth(error))
                continue
            if u is None or error > 1e-6:
                raise Unfit("no step")
            if mode.has_idle_slider():
                raise Unfit("a slider of which the force follows from nothing")
            step = Step(mode, t, own, x, v, u)
            found = self.first_end(step, is_fresh)
            if found:
                step = self.cut(step, *found)
            if step:
                self.steps.append(step)
                t = until if is_last and not found else t + step.h
                x, v = self.end_of(step)
                repeats = 0 if step.h > 1e-13 * self.duration else repeats
            if not found and not is_last:
                is_fresh, h = False, own * min(2.0, self.growth(error))
                continue
            if found:
                self.events, repeats = self.events + 1, repeats + 1
                if repeats > 6:
                    raise Unfit("events without end")
                x, v, phases = self.switch(mode, x, v, t, found[1])
            elif t < self.duration:
                phases, x = self.behind_break(mode, x, v, t)
            mode = Mode(self.network, phases, x)
            is_fresh, h = True, min(h, 1e-3 * self.duration)
        return self

    def growth(self, error):
        return 0.9 * (self.tolerance / max(error, 1e-300)) ** (1 / self.radau.s) if np.isfinite(error) else 0.3

    def first_phases(self, x):
        nodes = self.network.nodes
        v = np.array([own.velocity for own in nodes])
        for n, own in enumerate(nodes):
            if own.motion is not None:
                u = own.motion.at(np.array([0.0]), 1e-300)
                x[n], v[n] = u[0][0], u[1][0]
        phases = []
        for link in self.network.links:
            y, w = x[link.a] - x[link.b], v[link.a] - v[link.b]
            for level in (0.0, getattr(link.part, "gap", 0.0)):
                if abs(y - level) < 1e-12 * self.length:
                    y = level
            phases.append(link.part.start(y, w))
        x, v, phases = self.impacts(x, v, phases, 0.0)
        phases, x = self.settle(phases, x, v, 0.0, set(range(len(phases))))
        return x, v, phases

    def cut(self, step, part, guard):
        """The step up to an event, by a secant on its length; None where there is no way up to it."""
        at, what, sign, level, _ = guard
        pick = {"F": 3, "y": 4, "w": 5}[what]
        found = None
        for _ in range(4):
            if part < 1e-13:
                return None
            h = step.h * part
            u = self.step(step.mode, step.t, h, *self.start_of(step.mode, step.x, step.v))
            if u is None:
                raise Unfit("no step to an event")
            found = Step(step.mode, step.t, h, step.x, step.v, u)
            before, here = (sign * (self.signals(found, np.array([0.999, 1.0]))[pick][at] - level)).tolist()
            move = here * 0.001 / (before - here) if before != here else 0.0
            if abs(move) > 0.01 or abs(move) < 1e-15:
                break
            part *= 1 + move
        return found

    def end_of(self, step):
        """Places of all nodes and speeds of those that have one of their own."""
        mode = step.mode
        x, w = (own[:, 0].copy() for own in self.signals(step, np.array([1.0]))[:2])
        has_speed = [mode.mass[b] > 0 or mode.given[b] is not None for b in mode.body]
        return x, np.where(has_speed, w, 0.0)

    def behind_break(self, mode, x, v, t):
        """Phases and places where a function of time has a jump or kink."""
        for n, node in enumerate(self.network.nodes):
            if node.motion is not None:
                x[n] = node.motion.at(np.array([t]), t * (1 + 1e-15) + 1e-300)[0][0]
        held = {at for at, link in enumerate(self.network.links) if link.part.held(mode.phases[at]) is not None}
        return self.settle(list(mode.phases), x, v, t, held)
