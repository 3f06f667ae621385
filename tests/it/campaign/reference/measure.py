"""Measures of a run, by their definitions in docs/model.md, over all of it."""

import numpy as np
from numpy.polynomial.legendre import leggauss

G0 = 9.80665
GRID = np.linspace(0, 1, 33)
X, W = leggauss(24)
S = (X + 1) / 2
# Smooth ends: what is a power of the time there becomes a power twice as high.
GRADED, WEIGHTS = S**2 * (3 - 2 * S), W / 2 * 6 * S * (1 - S)
PLAIN, PLAIN_WEIGHTS = S, W / 2


class Signal:
    """One signal of a run: values at parts of a step."""

    def __init__(self, run, read):
        self.run, self.read = run, read
        self.steps = run.steps

    def at(self, k, theta):
        return self.read(*self.run.signals_at(k, theta))

    def peak(self):
        """The largest magnitude."""
        coarse = [np.abs(self.at(k, GRID)) for k in range(len(self.steps))]
        tops = np.array([own.max() for own in coarse])
        best = 0.0
        for k in np.argsort(-tops)[:4]:
            if tops[k] < 0.99 * tops.max():
                break
            at, width = GRID[int(np.argmax(coarse[k]))], GRID[1]
            for _ in range(7):
                fine = np.clip(np.linspace(at - width, at + width, 33), 0, 1)
                own = np.abs(self.at(k, fine))
                at, width = fine[int(np.argmax(own))], width / 12
                best = max(best, own.max())
        return best

    def end(self):
        return self.at(len(self.steps) - 1, np.array([1.0]))[0]

    def integral(self, of=lambda own: own):
        return sum(step.h * float(PLAIN_WEIGHTS @ of(self.at(k, PLAIN))) for k, step in enumerate(self.steps))

    def pieces(self):
        """(step, from, to) between zeros."""
        found = []
        for k in range(len(self.steps)):
            own = self.at(k, GRID)
            cuts = [0.0]
            for i in np.flatnonzero(own[:-1] * own[1:] < 0):
                a, b, fa = GRID[i], GRID[i + 1], own[i]
                for _ in range(60):
                    c = (a + b) / 2
                    fc = self.at(k, np.array([c]))[0]
                    a, b, fa = (c, b, fc) if fc * fa > 0 else (a, c, fa)
                cuts.append((a + b) / 2)
            cuts.append(1.0)
            found += [(k, a, b) for a, b in zip(cuts, cuts[1:])]
        return found

    def power(self, n):
        """The integral of |signal|^n."""
        total = 0.0
        for k, a, b in self.pieces():
            own = np.abs(self.at(k, a + (b - a) * GRADED)) ** n
            total += self.steps[k].h * (b - a) * float(WEIGHTS @ own)
        return total


# Part of the highest value on the grid that a top is climbed from, and how many tops are.
NEARLY, TOPS = 0.9, 12


def hic(signal, cap):
    """max of (t2 - t1) [|integral of a/g0| / (t2 - t1)]^2.5 with t2 - t1 <= cap."""
    return max(one_way(signal, cap, sense) for sense in (1.0, -1.0))


def one_way(signal, cap, sense):
    """The same of integrals with this sign."""
    nodes, total = [], 0.0
    pieces = signal.pieces()
    for k, a, b in pieces:
        step = signal.steps[k]
        nodes.append((step.t + a * step.h, k, a, b, total))
        own = sense * signal.at(k, a + (b - a) * PLAIN)
        total += step.h * (b - a) * float(PLAIN_WEIGHTS @ own) / G0
    starts = np.array([own[0] for own in nodes])
    end = signal.steps[-1].t + signal.steps[-1].h

    def speed(t):
        out = np.empty_like(t)
        for i, own in enumerate(t):
            _, k, a, b, before = nodes[max(0, int(np.searchsorted(starts, own, side="right")) - 1)]
            step = signal.steps[k]
            to = min(max((own - step.t) / step.h, a), b)
            part = sense * signal.at(k, a + (to - a) * PLAIN)
            out[i] = before + step.h * (to - a) * float(PLAIN_WEIGHTS @ part) / G0
        return out

    def best_of(one, two):
        v1, v2 = speed(one), speed(two)
        length = two[None, :] - one[:, None]
        rise = v2[None, :] - v1[:, None]
        good = (length > 0) & (length <= cap * (1 + 1e-14)) & (rise > 0)
        return np.where(good, np.maximum(rise, 0) ** 2.5 / np.where(good, length, 1.0) ** 1.5, 0.0)

    grid = np.unique(np.concatenate([np.linspace(0, end, 240), starts]))
    value = best_of(grid, grid)
    found = 0.0
    if value.max() == 0:
        return 0.0
    # Where the cap meets an end of the run.
    found = max(best_of(np.array([own]), np.array([own + cap]))[0, 0] for own in (0.0, end - cap))
    # Every top of the grid that is not far below the highest one.
    edged = np.pad(value, 1)
    around = [edged[1 + i : 1 + i + len(grid), 1 + j : 1 + j + len(grid)] for i in (-1, 0, 1) for j in (-1, 0, 1)]
    tops = np.argwhere((value >= np.max(around, axis=0)) & (value > NEARLY * value.max()))
    for i, j in tops[np.argsort(-value[tuple(tops.T)])][:TOPS]:
        found = max(found, climb(best_of, grid[i], grid[j], 1.5 * end / 239, cap, end))
    return found


def climb(best_of, t1, t2, width, cap, end):
    """The top near two times: a window around the best pair, which shrinks once that lies inside of it."""
    found, least = 0.0, 1e-13 * end
    for _ in range(200):
        if width < least:
            break
        one = np.clip(np.linspace(t1 - width, t1 + width, 9), 0, end)
        two = np.clip(np.linspace(t2 - width, t2 + width, 9), 0, end)
        table = best_of(one, two)
        i, j = np.unravel_index(int(np.argmax(table)), table.shape)
        best, now = (one[i], two[j], i, j), table[i, j]
        # Along the cap, too, where the grid misses it.
        capped = np.clip(one + cap, 0, end)
        line = np.array([best_of(one[i : i + 1], capped[i : i + 1])[0, 0] for i in range(len(one))])
        if line.max() >= now:
            i = int(np.argmax(line))
            best, now = (one[i], capped[i], i, 4), line[i]
        at_border = any(k in (0, 8) and 0 < t < end for k, t in zip(best[2:], best[:2]))
        rises = now > found * (1 + 1e-15)
        if now > found:
            t1, t2 = best[:2]
            found = now
        if not (at_border and rises):
            width /= 2.0
    return found


def contact(force):
    """The end of the impact: the first zero of the force after which it would pull. None where there is none."""
    top, has_pushed = 0.0, False
    for k, step in enumerate(force.steps):
        own = force.at(k, GRID)
        if not has_pushed and own.min() < 0:
            return None
        below = np.flatnonzero(own < -1e-12 * top)
        if has_pushed and np.abs(own).max() <= 1e-13 * top:
            return k, 0.0
        if len(below):
            i = below[0]
            if i == 0:
                return k, 0.0
            a, b = GRID[i - 1], GRID[i]
            for _ in range(60):
                c = (a + b) / 2
                a, b = (c, b) if force.at(k, np.array([c]))[0] > 0 else (a, c)
            return k, (a + b) / 2
        top = max(top, own.max())
        has_pushed = has_pushed or own.max() > 0
    return None


# Part of the most that a padding has borne at which it counts as unloaded.
UNLOADED = 0.01


def impact(force, power, touch):
    """Measures of what touches an impactor, from the start to the end of the impact. Where a face with mass is struck,
    `touch` is its contact: it ends no sooner than that opens."""
    found = contact(force)
    if found is None:
        return {}
    last, part = found
    if touch is not None:
        # What struck the face has left it for good before, and the padding bears next to nothing any more.
        closed = [k for k in range(last + 1) if force.steps[k].mode.phases[touch] == "closed"]
        if closed and closed[-1] < last:
            top = max(force.at(k, GRID).max() for k in range(closed[-1] + 1))
            if force.at(closed[-1], np.array([1.0]))[0] <= UNLOADED * top:
                last, part = closed[-1], 1.0
        while force.steps[last].mode.phases[touch] == "closed":
            last, part = last + 1, 0.0
            if last == len(force.steps):
                return {}
    lengths = [1.0] * last + [part]

    def until(signal):
        steps = zip(range(last + 1), lengths)
        return sum(force.steps[k].h * to * float(PLAIN_WEIGHTS @ signal.at(k, to * PLAIN)) for k, to in steps)

    step = force.steps[last]
    return {
        "contact-time": step.t + part * step.h,
        "impulse@impact": until(force),
        "energy@impact": until(power),
    }


def element(run, name, force, ends, struck, pulls, is_impact, touch):
    """Measures of an element: `force` is a list of (link, part), `touch` the contact of its face with mass."""
    a, b = ends
    F = Signal(run, lambda x, w, acc, F, y, dy: sum(share * F[at] for at, share in force))
    y = Signal(run, lambda x, w, acc, F, *_: x[a] - x[b])
    power = Signal(run, lambda x, w, acc, F, *_: sum(share * F[at] for at, share in force) * (w[a] - w[b]))
    # What never pulls is pressed by its deepest compression: what it is apart by is a gap.
    deepest = y if pulls else Signal(run, lambda x, *_: np.maximum(x[a] - x[b], 0))
    found = {"peak-deformation": deepest.peak(), "end-deformation": y.end()}
    if not struck:
        found |= {"peak-force": F.peak(), "impulse": F.integral(), "energy": power.integral()}
        if is_impact:
            found |= impact(F, power, touch)
    return {f"{name}.{kind}": own for kind, own in found.items()}


def node(run, network, n, struck, cap=None):
    """Measures of a mass."""
    own = network.nodes[n]
    x, w = Signal(run, lambda x, *_: x[n]), Signal(run, lambda x, w, *_: w[n])
    found = {"end-position": x.end(), "end-velocity": w.end(), "peak-displacement": x.peak()}

    if not struck and not own.loads:
        a = Signal(run, lambda x, w, acc, *_: acc[n] - network.gravity)
        found["peak-acceleration"] = a.peak()
        found["severity-index"] = a.power(2.5) / G0**2.5
        found["average-deceleration"] = abs(a.integral()) / run.duration
        if cap:
            found[f"hic@{cap!r}"] = hic(a, cap)
    return {f"{own.name}.{kind}": value for kind, value in found.items()}
