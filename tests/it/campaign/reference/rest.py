"""The start in balance under weight: springs carry it, dashpots nothing, sliders stick."""

import numpy as np

import laws
from bodies import Unfit


def is_face(network, name, node):
    return network.nodes[node].name == f"{name}.face"


def at_rest(network, struck):
    """Places of all nodes. What touches one of the elements `struck` hangs unloaded on the node beyond it.

    `struck` lists (name of an element, the node that is struck): the links between that and what strikes, which goes
    along with it, take no part. That node is the far one, or a face with mass, which sags by its own weight.
    """
    count = len(network.nodes)
    own_links, follows = [], {}
    for own in network.links:
        hits = [
            far
            for name, far in struck
            if own.name == f"{name}.contact" or not is_face(network, name, far) and own.name in (name, f"{name}.stop")
        ]
        if not hits:
            own_links.append(own)
        follows |= {n: far for far in hits for n in (own.a, own.b) if n != far}
    joined = list(range(count))
    for own in own_links:
        if isinstance(own.part, laws.Friction) or isinstance(own.part, laws.Contact) and own.name.endswith(".contact"):
            joined = [own_b if n == joined[own.a] else n for n in joined for own_b in (joined[own.b],)]
    x = np.array([own.motion.at(np.array([0.0]), 1e-300)[0][0] if own.motion else 0.0 for own in network.nodes])
    fixed = {joined[n] for n in range(count) if network.nodes[n].motion is not None}
    free = sorted({joined[n] for n in range(count) if n not in follows} - fixed)
    index = {b: i for i, b in enumerate(free)}
    for turn in range(200):
        R, K = np.zeros(len(free)), np.zeros((len(free), len(free)))
        for n, own in enumerate(network.nodes):
            if joined[n] in index and n not in follows:
                R[index[joined[n]]] += own.mass * network.gravity
        for own in own_links:
            if isinstance(own.part, (laws.Dashpot, laws.PowerDashpot, laws.Contact, laws.Friction)):
                continue
            y = np.array([x[own.a] - x[own.b]])
            F, k, _ = own.part.law(own.part.start(y[0], 0.0), y, 0 * y)
            i, j = index.get(joined[own.a]), index.get(joined[own.b])
            for row, sign in ((i, 1), (j, -1)):
                if row is not None:
                    R[row] -= sign * F[0]
                    for column, other in ((i, 1), (j, -1)):
                        if column is not None:
                            K[row, column] += sign * other * k[0]
        # Where a dashpot alone is in the way rounding hides that nothing holds.
        if len(free) and not np.linalg.cond(K) < 1e13:
            raise Unfit("no balance of the weights")
        try:
            d = np.linalg.solve(K, R) if len(free) else np.zeros(0)
        except np.linalg.LinAlgError:
            raise Unfit("no balance of the weights") from None
        for n in range(count):
            if joined[n] in index:
                x[n] += d[index[joined[n]]]
        if np.abs(d).max(initial=0.0) <= 1e-16 * np.abs(x).max():
            break
    for n, far in follows.items():
        x[n] = x[far]
    return x
