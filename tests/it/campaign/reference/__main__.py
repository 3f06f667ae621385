"""Scenes with reference values: python3 reference COUNT FILE [FIRST]. Needs numpy; some five seconds a scene.

Each scene is solved twice, with 8 and with 7 stages at another tolerance; what they differ by is the doubt about a
value. Scenes in which something happens that is a matter of convention or beyond rounding are left out and counted.
"""

import os
import sys
import time

sys.dont_write_bytecode = True
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import measure
import scenes
from bodies import Unfit
from motion import Solver


class Recorded(Solver):
    def signals_at(self, k, theta):
        key = (k, theta.tobytes())
        if key not in self.kept:
            self.kept[key] = self.signals(self.steps[k], theta)
        return self.kept[key]


def solved(seed, stages, tolerance):
    scene, s, duration = scenes.draw(seed)
    run = Recorded(scene.network, stages, tolerance)
    run.kept = {}
    run.begin(s.y, s.v, s.f, duration)
    run.run(scene.start())
    links = scene.network.links
    struck_links = {at for at, _ in run.struck}
    struck_nodes = {n for at in struck_links for n in (links[at].a, links[at].b)}
    found = {}
    cap = float(f"{0.4 * duration:.6g}")
    for name in scene.measured:
        force, ends = scene.forces(name)
        inner = any(links[at].name == name for at in struck_links)
        pulls, is_impact, touch = scene.pulls[name], scene.is_impact(name), scene.touches.get(name)
        found |= measure.element(run, name, force, ends, inner, pulls, is_impact, touch)
    # What is joined to a struck mass for good feels the impact, too.
    for n in scene.masses:
        found |= measure.node(run, scene.network, n, n in struck_nodes, cap if n == scene.masses[0] else None)
    return scene, scene.text(duration), found, run


def values(seed):
    scene, text, one, run = solved(seed, 8, 1e-11)
    other = solved(seed, 7, 3e-11)[2]
    if set(one) != set(other):
        raise Unfit("two solutions differ in kind")
    return scene, text, {key: (one[key], abs(one[key] - other[key])) for key in one}, run


def main(count, path, first=0):
    why, kept, seed, begin = {}, 0, first, time.time()
    file = open(path, "w")
    while kept < count:
        try:
            scene, text, found, run = values(seed)
        except (Unfit, ArithmeticError) as reason:
            words = str(reason)
            why.setdefault(words, []).append(seed)
            print(f"{seed}: left out: {words}", flush=True)
        else:
            lines = [f"{key} {float(value)!r} {float(doubt):.1e}" for key, (value, doubt) in found.items()]
            file.write(f"### {seed} {scene.kind}\n{text}---\n" + "\n".join(lines) + "\n")
            file.flush()
            kept += 1
            worst, key = max((doubt / max(abs(value), 1e-300), key) for key, (value, doubt) in found.items())
            print(
                f"{seed}: {len(run.steps)} steps, {run.events} events, doubt {worst:.1e} of {key}, {time.time() - begin:.0f} s",
                flush=True,
            )
        seed += 1
    file.close()
    print({words: len(own) for words, own in why.items()})


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 0)
