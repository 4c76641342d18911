"""Random legal buildings and random MDPs, for tests that hold for all of them."""

import numpy as np
from hypothesis import strategies as st

from abstransfer import MDP


def join(parent, a, b):
    """Merge the sets of a and b; return whether they were two."""
    first, second = root(parent, a), root(parent, b)
    parent[second] = first
    return first != second


def root(parent, item):
    """Return the name of the set that holds an item."""
    while parent[item] != item:
        item = parent[item]
    return item


@st.composite
def map_texts(draw, max_height=5, max_width=6):
    """
    Draw the text of a legal map.

    Random edges are open; the cells they join are a region, a room or a
    corridor; doors in random walls join all regions, some of them twice.
    """
    height = draw(st.integers(1, max_height))
    width = draw(st.integers(1 if height > 1 else 2, max_width))
    cells = [(i, j) for i in range(height) for j in range(width)]
    edges = [
        (cell, (cell[0] + di, cell[1] + dj))
        for cell in cells
        for di, dj in ((0, 1), (1, 0))
        if cell[0] + di < height and cell[1] + dj < width
    ]

    picture = {}
    for i in range(2 * height + 1):
        for j in range(2 * width + 1):
            picture[i, j] = "+" if i % 2 == j % 2 == 0 else "|" if i % 2 else "-"
    between = {(a, b): (a[0] + b[0] + 1, a[1] + b[1] + 1) for a, b in edges}

    region = {cell: cell for cell in cells}
    is_open = draw(st.lists(st.booleans(), min_size=len(edges), max_size=len(edges)))
    for edge, opened in zip(edges, is_open, strict=True):
        if opened:
            join(region, *edge)
            picture[between[edge]] = " "
    regions = sorted({root(region, cell) for cell in cells})

    first_room = draw(st.sampled_from(regions))
    rooms = draw(st.sets(st.sampled_from(regions))) | {first_room}
    room_cells = [cell for cell in cells if root(region, cell) in rooms]
    goals = draw(st.sets(st.sampled_from(room_cells), min_size=1, max_size=4))
    for i, j in cells:
        kind = " " if root(region, (i, j)) in rooms else "."
        picture[2 * i + 1, 2 * j + 1] = "*" if (i, j) in goals else kind

    joined = {name: name for name in regions}
    for edge in draw(st.permutations(edges)):
        ends = [root(region, cell) for cell in edge]
        if ends[0] != ends[1] and (join(joined, *ends) or draw(st.integers(0, 4)) == 0):
            picture[between[edge]] = "d"
    return "\n".join(
        "".join(picture[i, j] for j in range(2 * width + 1))
        for i in range(2 * height + 1)
    )


@st.composite
def mdps(draw, max_states=6, max_actions=3, masks=False):
    """
    Draw an MDP whose last state is terminal, and maybe others.

    With `masks`, some actions are not allowed.
    """
    n_states = draw(st.integers(2, max_states))
    n_actions = draw(st.integers(1, max_actions))
    n_outcomes = draw(st.integers(1, 3))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    terminal = rng.random(n_states) < 0.2
    terminal[-1] = True
    allowed = rng.random((n_states, n_actions)) < 0.6
    allowed[np.arange(n_states), rng.integers(n_actions, size=n_states)] = True
    shape = (n_states, n_actions, n_outcomes)
    return MDP(
        next_state=rng.integers(n_states, size=shape),
        prob=rng.dirichlet(np.ones(n_outcomes), size=shape[:2]),
        reward=rng.integers(-3, 4, size=n_states),  # integers: ties are frequent
        terminal=terminal,
        gamma=draw(st.sampled_from([0.0, 0.5, 0.9, 0.99])),
        allowed=allowed if masks else None,
    )


def random_policy(mdp, seed=0):
    """Return a policy (S, A) that gives every allowed action some probability."""
    weight = np.random.default_rng(seed).random((mdp.n_states, mdp.n_actions)) + 0.1
    weight *= mdp.allowed
    total = weight.sum(axis=1, keepdims=True)
    return np.divide(weight, total, out=np.zeros_like(weight), where=total > 0)


def dense_transitions(mdp, policy):
    """Return P (S, S) under a policy, entry by entry; terminal rows are 0."""
    p = np.zeros((mdp.n_states, mdp.n_states))
    for s in np.flatnonzero(~mdp.terminal):
        for a in range(mdp.n_actions):
            for s_next, share in zip(mdp.next_state[s, a], mdp.prob[s, a], strict=True):
                p[s, s_next] += policy[s, a] * share
    return p
