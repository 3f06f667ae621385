"""What happens at an event: impacts, and the phases that can go on."""

import itertools

import numpy as np

from bodies import Mode, Unfit


class Step:
    """One step: what began it, and the stages."""

    def __init__(self, mode, t, h, x, v, u):
        self.mode, self.t, self.h, self.x, self.v, self.u = mode, t, h, x, v, u


class Switching:
    """The part of a solver that decides how a motion goes on."""

    def switch(self, mode, x, v, t, guard):
        """State and phases behind an event."""
        at, what, sign, level, follower = guard
        link = self.network.links[at]
        phases = list(mode.phases)
        y = x[link.a] - x[link.b]
        phases[at] = link.part.enter(follower, y)
        if follower == "closed" and self.is_heavy(mode, link.a) and self.is_heavy(mode, link.b):
            wa, wb = (self.rate_of(mode, x, v, t, n) for n in (link.a, link.b))
            if abs(y - link.part.gap) > 1e-10 * self.length:
                raise Unfit("a bounce too short to tell")
            if wa - wb > 0:
                x, v, phases = self.impact(mode, x, v, phases, at, wa, wb, t)
        phases, x = self.settle(phases, x, v, t, {at})
        return x, v, phases

    def is_heavy(self, mode, n):
        b = mode.body[n]
        return mode.mass[b] > 0 or mode.given[b] is not None

    def rate_of(self, mode, x, v, t, n):
        b = mode.body[n]
        if mode.given[b] is not None:
            return self.network.nodes[mode.given[b]].motion.at(np.array([t]), t)[1][0]
        return v[mode.root[b]]

    def impacts(self, x, v, phases, t):
        """Those at the start."""
        open_all = [("open" if p == "closed" else p) for p in phases]
        mode = Mode(self.network, open_all, x)
        hits = []
        for at, link in enumerate(self.network.links):
            if phases[at] == "closed" and self.is_heavy(mode, link.a) and self.is_heavy(mode, link.b):
                wa, wb = self.rate_of(mode, x, v, t, link.a), self.rate_of(mode, x, v, t, link.b)
                if wa - wb > 1e-9 * self.speed:
                    hits.append((at, wa, wb))
        if len(hits) > 1:
            raise Unfit("several impacts at the start")
        for at, wa, wb in hits:
            x, v, phases = self.impact(mode, x, v, phases, at, wa, wb, t)
        return x, v, phases

    def impact(self, mode, x, v, phases, at, wa, wb, t):
        """Newton's law of impact between two bodies."""
        link = self.network.links[at]
        a, b = mode.body[link.a], mode.body[link.b]
        # Bounces that have become this small end at once: their heights and times go with the square.
        e = link.part.e if wa - wb > 1e-6 * self.speed else 0.0
        for other in mode.constraints:
            own = self.network.links[other]
            if mode.body[own.a] in (a, b) and type(own.part).__name__ != "Rigid":
                raise Unfit("an impact on bodies that are held")
        inverse = [0.0 if mode.given[own] is not None else 1 / mode.mass[own] for own in (a, b)]
        impulse = (1 + e) * (wa - wb) / sum(inverse)
        v = v.copy()
        for n, own in enumerate(mode.body):
            if mode.given[own] is None and own in (a, b) and mode.mass[own] > 0:
                v[n] += (-inverse[0] if own == a else inverse[1]) * impulse
        self.struck.add((at, t))
        phases = list(phases)
        phases[at] = "open" if e > 0 else "closed"
        for other, own in enumerate(self.network.links):
            if other != at and {mode.body[own.a], mode.body[own.b]} & {a, b}:
                phases[other] = self.behind_impact(mode, own, phases[other], x, v, t)
        return x, v, phases

    def behind_impact(self, mode, link, phase, x, v, t):
        """The phase of a part of which an end was struck: that of its new rate."""
        follows = [what for what, *_ in link.part.ends(phase)]
        if "w" not in follows:
            return phase
        word = type(link.part).__name__
        if not self.is_heavy(mode, link.a) or not self.is_heavy(mode, link.b) or word == "Hysteretic":
            raise Unfit(f"an impact beside a {word}")
        now = Mode(self.network, mode.phases, x)
        y, w = x[link.a] - x[link.b], self.rate_of(now, x, v, t, link.a) - self.rate_of(now, x, v, t, link.b)
        if word == "Friction" and abs(w) < 1e-9 * self.speed:
            return ("stuck", y)
        return link.part.start(y, w)

    def alternatives(self, at, phase, x):
        """The phase, and those that could be in its place."""
        link = self.network.links[at]
        word = type(link.part).__name__
        y = x[link.a] - x[link.b]
        if word == "Contact":
            near = abs(y - link.part.gap) < 1e-10 * self.length
            return [phase] + [own for own in ("closed", "open") if own != phase and near]
        if word == "Friction":
            every = [("slide", 1), ("slide", -1), ("stuck", y)]
            return [phase] + [own for own in every if own[0] != phase[0] or own[0] == "slide" and own != phase]
        # One end of the phase, or two of them at once.
        found = [phase]
        for own in found:
            if len(found) > 4:
                break
            for what, _, level, follower in link.part.ends(own):
                is_near = what == "w" and level == 0.0 or what == "y" and abs(y - level) < 1e-10 * self.length
                after = link.part.enter(follower, y)
                if is_near and after not in found and not (follower == ("turn",) and y <= 0):
                    found.append(after)
        return found

    def settle(self, phases, x, v, t, first):
        """Phases that can go on: those given, or with as few others as possible of what lies at its level."""
        tried = 0
        options = [self.alternatives(at, phase, x) for at, phase in enumerate(phases)]
        movable = [at for at, own in enumerate(options) if len(own) > 1]
        for count in range(0, min(4, len(movable)) + 1):
            chosen = sorted(itertools.combinations(movable, count), key=lambda own: -len(first & set(own)))
            for group in chosen:
                for own in itertools.product(*(options[at][1:] for at in group)):
                    trial = list(phases)
                    for at, phase in zip(group, own):
                        trial[at] = phase
                    tried += 1
                    if tried > 300:
                        raise Unfit("too many phases")
                    placed = self.goes_on(trial, x, v, t)
                    if placed is not None:
                        return trial, placed
        raise Unfit("no phases can go on")

    def goes_on(self, phases, x, v, t):
        """Whether a short step of these phases keeps all guards; the places, massless ones in balance."""
        try:
            mode = Mode(self.network, phases, x)
        except Unfit:
            return None
        # Heavy parts of one body have one speed.
        for n, b in enumerate(mode.body):
            if mode.given[b] is not None and self.network.nodes[n].mass > 0:
                if abs(v[n] - self.rate_of(mode, x, v, t, n)) > 1e-9 * self.speed:
                    return None
            elif mode.mass[b] > 0 and self.network.nodes[n].mass > 0:
                if abs(v[n] - v[mode.root[b]]) > 1e-9 * self.speed:
                    return None
        before, x = x, self.balanced(mode, x, v, t)
        if x is not None:
            # What slides does not jump.
            for link in self.network.links:
                if hasattr(link.part, "strength"):
                    jump = x[link.a] - x[link.b] - before[link.a] + before[link.b]
                    if abs(jump) > 1e-9 * self.length:
                        return None
        if x is None:
            return None
        X, V = self.start_of(mode, x, v)
        h = 1e-4 * self.duration
        for _ in range(9):
            u = self.step(mode, t, h, X, V)
            if u is not None and self.error(mode, h, u) < 1e-7:
                break
            h /= 10
        if u is None:
            return None
        step = Step(mode, t, h, x, v, u)
        theta = np.array([0.001, 0.005, 0.02, 0.1, 0.3, 0.6, 1.0])
        _, _, _, F, y, w = self.signals(step, theta)
        # A rate of what is massless is known as well as its place, in parts of the step.
        noise = {"y": 1e-12 * self.length, "w": 1e-10 * self.speed + 1e-14 * self.length / h, "F": 1e-10 * self.force}
        values = {"y": y, "w": w, "F": F}
        for at, what, sign, level, _ in self.guards(mode):
            own = sign * (values[what][at] - level)
            # What leaves its level upwards may come back within the step.
            told = np.flatnonzero(np.abs(own) > noise[what])
            if len(told) and own[told[0]] < 0:
                return None
        return x

    def balanced(self, mode, x, v, t):
        """Places with algebraic massless bodies in balance; None if there is none."""
        groups = {i: i for i in range(len(mode.free))}
        anchored = {i for i in groups if mode.heavy[i]}
        for at in mode.laws:
            part = self.network.links[at].part
            if not part.has_rate:
                continue
            i, j = mode.map[self.ia[at]], mode.map[self.ib[at]]
            if i < 0 or j < 0:
                anchored |= {groups[own] for own in (i, j) if own >= 0}
                continue
            if mode.heavy[i] or mode.heavy[j]:
                anchored |= {groups[own] for own in (i, j) if not mode.heavy[own]}
                continue
            old, new = groups[i], groups[j]
            if old != new:
                for own in groups:
                    if groups[own] == old:
                        groups[own] = new
                if old in anchored:
                    anchored.add(new)
        loose = sorted({groups[i] for i in groups if not mode.heavy[i] and groups[i] not in anchored})
        X, V = self.start_of(mode, x, v)
        times = np.array([t])
        when = t * (1 + 1e-15) + 1e-300
        if loose:
            moves = np.zeros((len(mode.free), len(loose)))
            for k, own in enumerate(loose):
                for i in groups:
                    if groups[i] == own and not mode.heavy[i]:
                        moves[i, k] = 1.0
            z, last = np.zeros(len(loose)), np.inf
            for turn in range(60):
                place = (X + moves @ z)[:, None]
                R, K, _, _ = self.residual(mode, times, when, place, 0 * place + V[:, None], 0 * place)
                J, r = moves.T @ K[0] @ moves, moves.T @ R[:, 0]
                if not np.all(np.isfinite(J)) or np.any(np.abs(np.diag(J)) < 1e-250):
                    return None
                try:
                    d = np.linalg.solve(J, -r)
                except np.linalg.LinAlgError:
                    return None
                z = z + d
                change = np.abs(d).max() / self.length
                if change < 1e-15 or change < 1e-12 and change > 0.3 * last:
                    break
                last = change
            else:
                return None
            X = X + moves @ z
        places = self.places(mode, times, when, X[:, None], np.zeros((len(X), 1)))[0][:, 0]
        return places
