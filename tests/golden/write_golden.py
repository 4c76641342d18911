"""
Write the golden files: what the Python package finds, for JavaScript to equal.

Run it after a change that means to change results::

    cd tests; python -m golden.write_golden

``tests/scenes/test_engine.py`` checks that the files are what the code finds today,
and ``tests/scenes/js`` that the browser's engine finds the same.  Whole numbers and
learning runs must be equal; long arrays of whole numbers are kept as a digest.
"""

import hashlib
import json
from pathlib import Path

import numpy as np
from golden.foreign_texts import TEXTS

import abstransfer as at
from abstransfer.builders import abstract_policies
from abstransfer.driving import PAPER
from abstransfer.experiments.arms import ARMS
from abstransfer.learning import q_learning

HERE = Path(__file__).parent
SHIPPED = ("source", "target", "target_b", "target_c", "target_d")
SHORT = 120  # entries; longer arrays of whole numbers are kept as a digest

ROOM = "+---+\n|.d*|\n+---+"
CORRIDOR = "+-+-+-+\n|*d.d*|\n+-+ +-+\n| d. .|\n+-+-+-+"
DRAWN = (
    ROOM,
    CORRIDOR,
    "+-----+\n|     |\n|  *  |\n|     |\n+-----+",
    "\n\n" + ROOM + "\n \n",
    " \t\r\n" + ROOM.replace("\n", "\r\n") + "\x0b\u2028\x85",
    "+-+\n|*|\n+ +\n| |\n+-+",
    "  -  \n|* .|\n|+d+|\n| * |\n+---+".replace("  -  ", "+---+").replace("* .", "* *"),
)
NOT_DRAWN = (
    "",
    "\n \n",
    "+-+\n|*|\n+-+",
    "+---+\n|* |\n+---+",
    "+---+\n|*  |",
    "+--+\n|* |\n+--+",
    "+---+\n|*   \n+---+",
    "+-d-+\n|*  |\n+---+",
    "+---+\n|*#.|\n+---+",
    "+---+\n|*'x|\n+---+",
    "+---+\n|\t *|\n+---+",
    "+---+\n|* \\|\n+---+",
    "+---+\n|\u00e9 *|\n+---+",
    "+---+\n|\u200b *|\n+---+",
    "+---+\n|\U0001f600 *|\n+---+",
    "+---+\n|. *|\n+---+",
    "+---+\n|  .|\n+---+",
    "+---+\n| d*|\n|   |\n| . |\n+---+",
    "+---+\n| d*|\n+ + +\n|   |\n+---+",
    "+---+\n|   |\n+---+",
    "+---+\n| |*|\n+---+",
    "\n\n+---+\n| |*|\n+---+",
    "\n\n+---+\n|* |\n+---+",
    "\ufeff+---+\n|  *|\n+---+",
)


def numbers(array) -> list | str:
    """Return whole numbers as a list, or a long array of them as a digest."""
    array = np.asarray(array).ravel()
    if array.size <= SHORT:
        return array.astype(int).tolist()
    return hashlib.sha256(array.astype("<i4").tobytes()).hexdigest()[:32]


def random_building(rng, height: int, width: int) -> str:
    """Return the text of a random building, legal or nearly so."""
    block = rng.integers(1, 4, 2)  # regions are made of blocks: 0 is a corridor
    region = np.kron(rng.integers(0, 4, (height, width)), np.ones(block, int))
    region = region[:height, :width]
    has_goal = (region > 0) & (rng.random(region.shape) < 0.15)
    chars = np.full((2 * height + 1, 2 * width + 1), "+")
    chars[1::2, 1::2] = np.where(has_goal, "*", np.where(region, " ", "."))
    chars[::2, 1::2], chars[1::2, ::2] = "-", "|"
    for rows, columns in ((2, 0), (0, 2)):  # edges to the south, then to the east
        one = region[: height - rows // 2, : width - columns // 2]
        other = region[rows // 2 :, columns // 2 :]
        edges = chars[1 + rows // 2 : -1 : 2, 1 + columns // 2 : -1 : 2]
        edges = edges[: one.shape[0], : one.shape[1]]
        edges[one == other] = " "
        edges[(one != other) & (rng.random(one.shape) < 0.6)] = "d"
    return "\n".join("".join(line) for line in chars)


def mutated(rng, text: str) -> str:
    """Return the text with one character replaced by another of the format."""
    place = rng.choice([i for i, char in enumerate(text) if char != "\n"])
    return text[:place] + rng.choice(list("+-| d.*")) + text[place + 1 :]


def answer(function, *arguments):
    """Return the map that a call gives, as text, or the message of its refusal."""
    try:
        return {"text": str(function(*arguments))}
    except ValueError as error:
        return {"message": str(error)}


def random_texts() -> list[str]:
    """Return texts of random buildings, some legal, all different."""
    rng = np.random.default_rng(4)
    texts = []
    while len(texts) < 60:
        texts.append(random_building(rng, *rng.integers(2, 8, 2)))
    texts += [mutated(rng, text) for text in DRAWN for _ in range(12)]
    return list(dict.fromkeys(texts))


def small_maps() -> list[at.Map]:
    """Return the drawn maps and the legal ones among the random texts."""
    maps = []
    for text in (*DRAWN, *random_texts()):
        try:
            maps.append(at.parse_map(text))
        except ValueError:
            continue
    return list(dict.fromkeys(maps))


def sample(array, count: int = 16) -> dict:
    """Return about `count` entries of a flat array, each step-th from the first."""
    array = np.asarray(array, dtype=float).ravel()
    step = max(1, array.size // count | 1)  # odd: passes through all actions
    return {"step": step, "values": array[::step].tolist()}


def map_facts(map_: at.Map) -> dict:
    """Return what a map is made of."""
    return {
        "text": str(map_),
        "shape": list(map_.shape),
        "cells": "".join(map_.cells),
        "goals": map_.goals.tolist(),
        "neighbors": numbers(map_.neighbors),
        "doors": numbers(map_.doors),
        "regions": numbers(map_.regions),
        "rooms": map_.n_rooms,
        "n_doors": map_.n_doors,
    }


def maps_golden() -> dict:
    """Return maps, and drawings that are refused."""
    texts = dict.fromkeys((*DRAWN, *NOT_DRAWN, *TEXTS, *random_texts()))
    return {
        "shipped": {name: map_facts(at.read_map(name)) for name in SHIPPED},
        "small": [map_facts(map_) for map_ in small_maps()],
        "parsed": [{"drawn": text} | answer(at.parse_map, text) for text in texts],
    }


OPTIONS = (
    {},
    {"reward": "goal", "gamma": 0.9, "success": 1.0},
    {"near": 1, "almost_near": 3, "features": at.FEATURES[2:9], "keep": [0]},
    {"features": at.FEATURES[8:], "keep": [-1], "success": 0.5},
)


def task_cases():
    """Yield (name or text, map, options): shipped maps, and every small one."""
    for name in SHIPPED:
        yield name, at.read_map(name), {}
    for i, map_ in enumerate(small_maps()):
        options = dict(OPTIONS[i % len(OPTIONS)])
        if options.get("keep") == [-1]:
            options["keep"] = [len(map_.goals) - 1]
        yield str(map_), map_, options


def task_facts(tasks: at.NavigationTasks) -> dict:
    """Return the whole numbers that tasks are made of."""
    shown = np.unique(tasks.rho[~tasks.mdp.terminal])
    return {
        "states": tasks.mdp.n_states,
        "abstract_states": shown.tolist(),
        "goal": tasks.goal.tolist(),
        "labels": numbers(tasks.labels),
        "rho": numbers(tasks.rho),
        "available": numbers(tasks.available),
        "terminal": numbers(tasks.mdp.terminal),
        "reward": numbers(tasks.mdp.reward),
        "possible": numbers(tasks.possible),
        "described": at.describe(int(shown[-1]), tasks.features),
    }


def value_facts(tasks: at.NavigationTasks, iterations: int) -> dict:
    """Return values and policies: a sample of each, and the mean value."""
    mdp, rho, possible = tasks.mdp, tasks.rho, tasks.possible
    v = at.optimal_values(mdp)
    optimal = at.optimal_actions(mdp, v)
    votes = at.break_ties(optimal)
    prob = at.induce_probabilistic(votes, rho, possible)
    climb = at.absprob_pi(mdp, rho, possible, iterations=iterations)
    uniform = at.uniform_policy(possible)
    gradient = at.abstract_gradient(mdp, uniform, rho)
    sweep = at.value_iteration(mdp)
    swept = [next(sweep) for _ in range(6)][-1]
    shown = np.unique(rho[~mdp.terminal])
    policies = {
        "prob": prob,
        "nd": at.induce_nondeterministic(votes, rho, possible),
        "first": at.induce_probabilistic(
            at.break_ties(optimal, "first"), rho, possible
        ),
        "grad": climb.policy,
        "beta_0.5": at.beta_policy(prob, 0.5),
        "beta_3": at.beta_policy(prob, 3),
        "beta_inf": at.beta_policy(prob, np.inf),
    }
    guides = {name: policy[rho] for name, policy in policies.items()}
    guides["rand"] = at.uniform_policy(mdp.allowed)
    guides["available"] = at.uniform_policy(tasks.available)
    values = {name: at.evaluate_policy(mdp, guide) for name, guide in guides.items()}
    values |= {"optimal": v, "swept": swept}
    return {
        "optimal_actions": numbers(optimal),
        "votes": sample(at.count_votes(votes, rho, tasks.n_abstract)[shown]),
        "policies": {name: sample(p[shown], 40) for name, p in policies.items()},
        "everywhere": sample(prob, 20),
        "values": {
            name: sample(x) | {"mean": float(x.mean())} for name, x in values.items()
        },
        "iterations": iterations,
        "history": sample(climb.history),
        "value": gradient[0],
        "gradient": sample(gradient[1][shown]),
        "visits": sample(gradient[2][shown]),
    }


def tasks_golden() -> dict:
    """Return tasks, values and policies of many maps, and Table 1."""
    cases = []
    for i, (name, map_, options) in enumerate(task_cases()):
        tasks = at.navigation_tasks(map_, **options)
        case = {"map": name, "options": options} | task_facts(tasks)
        if name == "source":
            case |= value_facts(tasks, 300)
        elif name == "target":
            case |= value_facts(tasks, 20)
        elif name not in SHIPPED and i % 3 == 0:
            case |= value_facts(tasks, 40)
        cases.append(case)
    source, target = (at.navigation_tasks(at.read_map(m)) for m in SHIPPED[:2])
    betas = [
        {
            "beta": str(beta),
            "from": p,
            "to": at.beta_policy(np.array([p]), beta).tolist(),
        }
        for beta in (0, 0.3, 2, 1e3, np.inf)
        for p in ([0.75, 0.25] + [0.0] * 6, [0.1 + 0.2, 0.3, 0.2, 0.2] + [0.0] * 4)
    ]
    return {
        "cases": cases,
        "betas": betas,
        "table1": at.table1(source, target),
        "paper": PAPER,
    }


SEEDS = ((0, ()), (7, ()), (2015, (0, 3)), (2**40 + 7, (1,)), (2**130 + 5, (2**33,)))
SEED = 2015, (0, 3)
ODD = (
    {"epsilon": 0.0, "q0": 0.5},
    {"epsilon": 1.0, "alpha": 1.0, "gamma": 1.0, "max_episode": 7},
    {"epsilon": 0.3, "alpha": 0.5, "gamma": 0.5, "q0": -2.0, "max_episode": 20},
)


def runs():
    """Yield (map, options of its tasks, guide, options of its run), each a run."""
    taus = {"hard": 20_000, "soft": 45_000}
    advice = [
        {"strategy": arm.strategy, "tau": taus[arm.strategy]} if arm.guide else {}
        for arm in ARMS
    ]
    for reward in ("goal", "cost"):
        for arm, options in zip(ARMS, advice, strict=True):
            yield "source", {"reward": reward}, arm.guide, options
    for i in (0, 2, 6):
        yield "target", {"reward": "goal"}, ARMS[i].guide, advice[i]
    for i, map_ in enumerate(small_maps()[::4]):
        tasks = {"reward": ("goal", "cost")[i % 2], "success": (0.9, 1.0, 0.5)[i % 3]}
        guide = {"strategy": ("soft", "hard")[i % 2], "tau": 1 << 16}
        yield str(map_), tasks, ("rand", "nd")[i % 2], ODD[i % 3] | guide


def exact(q) -> str:
    """Return a digest of values, every bit of them."""
    return hashlib.sha256(np.ascontiguousarray(q, "<f8").tobytes()).hexdigest()[:32]


def learning_golden() -> dict:
    """Return what runs of the learner do, and the random stream they share."""
    source = at.navigation_tasks(at.read_map("source"))
    guides = abstract_policies(source)
    guides["rand"] = np.full(source.possible.shape, 1 / len(source.actions))
    cases = []
    for name, task_options, guide, options in runs():
        map_ = at.read_map(name) if name in SHIPPED else at.parse_map(name)
        tasks = at.navigation_tasks(map_, **task_options)
        result = q_learning(
            tasks.mdp,
            60_000,
            rng=np.random.SeedSequence(SEED[0], spawn_key=SEED[1]),
            guide=None if guide is None else guides[guide][tasks.rho],
            window=10_000,
            trace=24,
            checkpoints=[1000, 20_000],
            **options,
        )
        values = [*result.checkpoints, result.q]
        cases.append(
            {"map": name, "tasks": task_options, "guide": guide, "options": options}
            | {"goals": result.goals.tolist(), "cuts": result.cuts.tolist()}
            | {"q": [exact(q) for q in values], "largest": float(result.q.max())}
            | {"trace": {k: x.tolist() for k, x in result.trace._asdict().items()}}
        )
    streams = [
        {"seed": str(seed), "key": [str(k) for k in key]}
        | {
            "state": np.random.SeedSequence(seed, spawn_key=key)
            .generate_state(8)
            .tolist()
        }
        for seed, key in SEEDS
    ]
    return {
        "seed": SEED[0],
        "key": SEED[1],
        "cases": cases,
        "streams": streams,
    }


GOLDEN = {"maps": maps_golden, "tasks": tasks_golden, "learning": learning_golden}


def read(name: str):
    """Return what a golden file holds."""
    return json.loads((HERE / f"{name}.json").read_text(encoding="utf-8"))


def as_json(value):
    """Return a value as it comes back from a file."""
    return json.loads(json.dumps(value))


def write(name: str) -> None:
    """Write a golden file: one line per entry, so that a change is easy to read."""
    parts = []
    for key, value in GOLDEN[name]().items():
        items = [json.dumps(item) for item in value] if isinstance(value, list) else []
        text = "[\n" + ",\n".join(items) + "\n]" if items else json.dumps(value)
        parts.append(f"{json.dumps(key)}: {text}")
    text = "{\n" + ",\n".join(parts) + "\n}\n"
    (HERE / f"{name}.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    for name in GOLDEN:
        write(name)
