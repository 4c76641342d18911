"""
What a reader should have seen in a scene, computed: the phrases of the folded answers.

For each page a function that yields, for each numbered question under its scene, the
phrases that the answer must hold.  No number may stand in an answer outside of them.
"""

import numpy as np
import pytest

import abstransfer as at
from abstransfer.learning import q_learning
from abstransfer.maps import parse_map
from abstransfer.scenes import (
    Ballot,
    Dial,
    Filling,
    Hill,
    Ladder,
    Microscope,
    Paint,
    Project,
    Race,
    Ripple,
    Studio,
    Surgery,
    Whisper,
)
from abstransfer.scenes.hill.widget import HALL, RHO, advice
from abstransfer.scenes.microscope.widget import STARTS
from abstransfer.scenes.whisper.widget import POWERS


def place(map_, cell):
    """Return a cell as scenes say it: counted from 1."""
    row, column = divmod(int(cell), map_.shape[1])
    return f"row {row + 1}, column {column + 1}"


def first(condition):
    """Return where a condition holds first, counted from 1."""
    return int(np.argmax(condition)) + 1


def page_00():
    """Where the robots part, and their curves."""
    race = Race()
    traces = {arm.name: race.first_steps(arm) for arm in race.arms}
    none, walks = traces["none"], traces["rand-hard"]
    goal = first(none.reward > 0)
    assert (none.next_state[:goal] == walks.next_state[:goal]).all()
    parts = {
        name: first(traces[name].next_state != none.next_state)
        for name in ("prob-hard", "nd-hard")
    }
    yield [
        f"step {parts['prob-hard']}",
        f"step {parts['nd-hard']}",
        f"step {goal}",
    ]
    results = at.experiments.read_results("goal-target")
    curves = {name: results.curves(name)[race.luck - 1] for name in traces}
    takes_off = {name: first(curve > 1000) / 2 for name, curve in curves.items()}
    order = ["nd-hard", "prob-hard", "rand-hard", "none"]
    assert sorted(takes_off, key=takes_off.get) == order
    late = sorted(curves, key=lambda name: -curves[name][-10:].mean())
    assert late[:2] == ["rand-hard", "nd-hard"]
    yield [
        "1,000 goals in half a million steps",
        *(f"{takes_off[name]:g} million" for name in order),
        f"{curves['rand-hard'][-10:].mean():,.0f}",
        f"{curves['nd-hard'][-10:].mean():,.0f}",
    ]
    totals = np.array([results.totals(name) for name in order])
    assert (np.diff(totals, axis=0) < 0).all()
    yield [f"all {totals.shape[1]} runs"]


def doors(map_):
    """Yield the texts of a map with one more door, where that is legal."""
    lines = str(map_).split("\n")
    for i in range(1, len(lines) - 1):
        for j in range(1, len(lines[0]) - 1):
            if i % 2 != j % 2 and lines[i][j] in "-|":
                text = [*lines[:i], lines[i][:j] + "d" + lines[i][j + 1 :]]
                try:
                    yield parse_map("\n".join([*text, *lines[i + 1 :]]))
                except ValueError:
                    continue


def page_01():
    """A closed door, a second door, and an open building."""
    map_ = Studio().map
    text = str(map_)
    for i in [i for i, sign in enumerate(text) if sign == "d"]:
        wall = "-" if text.count("\n", 0, i) % 2 == 0 else "|"
        with pytest.raises(ValueError, match="this region cannot be reached"):
            parse_map(text[:i] + wall + text[i + 1 :])
    assert map_.n_doors == map_.n_rooms
    yield [f"{map_.n_doors} doors"]

    def judged(map_):
        mdp = at.navigation_tasks(map_).mdp
        wanderer = at.evaluate_policy(mdp, at.uniform_policy(mdp.allowed))
        return wanderer.mean(), at.optimal_values(mdp).mean()

    gains = np.array([judged(other) for other in doors(map_)]) - judged(map_)
    best = (gains[:, 1] > gains[:, 0]).sum()
    yield [
        f"{best} of the {len(gains)} places",
        f"{gains[:, 1].mean():.1f} coins",
        f"{gains[:, 0].mean():.1f}",
    ]
    inside = ["|       |"] * 7
    inside[4] = "|    *  |"
    room = Studio(map="\n".join(["+-------+", *inside, "+-------+"])).row
    assert f"{room['prob']:.2f}" == f"{room['optimal']:.2f}"
    yield ["4 rows and 4 columns", f"{room['prob']:.2f}"]


def page_02():
    """The sixth sweep, the news everywhere, and moves that never fail."""
    wave = Ripple()
    far, farthest = wave.news.max(), wave.news.argmax()
    hear = wave.news == 6
    assert len(set(wave.sweeps[5][hear])) == 1
    yield [f"{hear.sum()} cells", f"{wave.sweeps[5][hear][0]:.2f}"]
    end = len(wave.sweeps) - 1
    yield [
        f"sweep {far}",
        place(wave.map, farthest),
        f"{wave.sweeps[far][farthest]:.2f}",
        f"{at.optimal_values(wave.tasks.mdp)[farthest]:.2f}",
    ]
    sure = Ripple(success=1.0)
    tasks, chance = sure.tasks, 0
    for s in np.flatnonzero(~tasks.mdp.terminal):
        best = np.flatnonzero(sure.best_actions[s])
        chance += all((tasks.labels[s] == a).sum() > 1 for a in best)
    yield [
        f"{len(sure.sweeps) - 1} sweeps",
        f"{end}",
        f"{sure.news.max()} steps",
        f"{chance} of {(~tasks.mdp.terminal).sum()} cells",
    ]


def page_03():
    """The first goal, what learns from it, and how the payer begins."""
    scenes = {start: Microscope(start=start) for start in STARTS}
    traces = {
        start: q_learning(
            scene.tasks.mdp, 300, rng=scene.luck, q0=STARTS[start][1], trace=300
        ).trace
        for start, scene in scenes.items()
    }
    paid, map_ = traces["goal"], scenes["goal"].map
    changes = np.flatnonzero(paid.before != paid.after)
    one, two, three = changes[:3]
    assert one + 1 == scenes["goal"].t, "the scene opens at the first goal"
    assert paid.next_state[two] == paid.state[one]
    assert (paid.action[[one, two]] == 0).all()
    yield [
        f"step {one + 1}",
        place(map_, paid.state[one]),
        f"from {paid.before[one]:g} to {paid.after[one]:g}",
    ]
    yield [
        f"step {two + 1}",
        place(map_, paid.state[two]),
        f"from {paid.before[two]:g} to {paid.after[two]:.3f}",
        f"from {paid.before[three]:g} to {paid.after[three]:.2f}",
    ]
    tried = {
        start: len(set(zip(trace.state[:20], trace.action[:20], strict=True)))
        for start, trace in traces.items()
    }
    changed = (traces["cost"].before != traces["cost"].after)[:20]
    assert changed.all()
    assert one > 20
    yield [f"{tried['cost']} different entries", f"{tried['goal']} of them"]


def page_04():
    """A corner found again, a goal moved, and the answer that is missed most."""
    paint = Paint()
    home = paint.shown["source"]
    corner = Paint(z=int(home.rho[0]))
    for name, map_ in (("source", paint.source), ("target", paint.map)):
        neighbors = map_.neighbors[corner.lit[name]]
        assert ((neighbors < 0).sum(axis=1) == 2).all(), "each is a corner"
        assert not ((neighbors < 0)[:, :2] == (neighbors < 0)[:, 2:]).any()
    found = corner.lit["target"]
    yield [place(paint.source, 0), *(place(paint.map, cell) for cell in found)]
    moved = Paint(task=1)
    changed = (moved.shown["source"].rho != home.rho).mean()
    yield [
        *(place(paint.source, cell) for cell in paint.lit["source"]),
        *(place(paint.source, cell) for cell in moved.lit["source"]),
        f"{changed:.0%}".replace("%", " %"),
    ]
    right = {
        name: Paint(features=[f for f in at.FEATURES if f != name]).counts.right
        for name in at.FEATURES
    }
    missed = min(right, key=right.get)
    assert missed == "see_door_far_head_to_goal"
    yield [f"{100 * right[missed]:.0f} %", f"{100 * paint.counts.right:.0f} %"]


def page_05():
    """Who votes in the box, the ends of the dial, and boxes that it leaves alone."""
    ballot = Ballot()
    source = at.navigation_tasks(ballot.source)
    optimal = at.optimal_actions(source.mdp, at.optimal_values(source.mdp))
    best = at.break_ties(optimal)
    box = np.flatnonzero((source.rho == ballot.z) & ~source.mdp.terminal)
    here = [s for s in box if source.task[s] == ballot.task]
    others = [int(source.task[s]) + 1 for s in box if s not in here]
    assert others == [1, 1, 2, 5, 11]
    assert [best[s].argmax() for s in here] == [1, 4]
    yield [*(place(ballot.source, source.cell[s]) for s in here), "1, 2, 5 and 11"]
    nd, prob, winner = (Ballot(beta=b).advice[ballot.z, 4] for b in (0, 1, np.inf))
    assert winner == 0
    yield [f"{prob:.3f}", f"{nd:.3f}", "to 0"]
    votes = at.count_votes(best, source.rho, source.n_abstract)
    votes = votes[votes.sum(axis=1) > 0]
    one = ((votes > 0).sum(axis=1) == 1).sum()
    level = sum(len(set(row[row > 0].round(9))) == 1 for row in votes) - one
    assert level == 1
    yield [f"{one} of {len(votes)} boxes"]


def page_06():
    """Two climbs, their tops by start, and a leap over the saddle."""
    low, high = (Hill(p=p, q=q) for p, q in ((0.3, 0.3), (0.7, 0.6)))
    ends = [scene.climb() for scene in (low, high)]
    near = np.linspace(0, 0.2, 21)
    values = [[low.value(p, q) for p in near] for q in near]
    assert np.argmax(values) == 0, "no advice close to the corner is better"
    yield [
        f"p = q = {ends[0].policy[0, 0]:.2f}",
        f"p = q = {ends[1].policy[0, 0]:.2f}",
        f"{low.value(0, 0):.2f}",
        f"{low.value(0.1, 0):.2f}",
    ]
    tops = {
        start: [Hill(start=start).value(p, p) for p in (1, 0)]
        for start in ("landing", "both")
    }
    assert tops["both"][0] == tops["both"][1]
    yield [
        f"{tops['landing'][1]:.2f}",
        f"{tops['landing'][0]:.2f}",
        f"{tops['both'][0]:.2f}",
    ]
    leap = Hill(p=0.2, q=0.6)
    step = leap.climb(1).policy[:2, 0]
    careful = at.natural_ascent(
        HALL, RHO, np.ones((3, 2), bool), initial=advice(0.2, 0.6), start=np.eye(5)[0]
    )
    yield [
        f"p = {step[0]:.2f}, q = {step[1]:.2f}",
        f"{leap.climb().history[-1]:.2f}",
        f"{careful.history[-1]:.2f}",
    ]


def page_07():
    """What advice loses abroad, one more door, and another order."""
    names = ("nd", "prob", "grad")
    table = Ladder().table
    lost = {row: table["source"][row] - table["target"][row] for row in names}
    assert max(lost, key=lost.get) == "grad"
    yield [f"{lost['grad']:.1f}", f"{lost['nd']:.1f}", f"{lost['prob']:.1f}"]
    door = Ladder(source=at.read_map("source").add_door((1, 2), "E")).table
    moved = {
        side: {row: door[side][row] - table[side][row] for row in names}
        for side in ("source", "target")
    }
    for side in moved.values():
        assert max(side, key=lambda row: abs(side[row])) == "nd"
    yield [f"{-moved[side]['nd']:.1f}" for side in ("source", "target")]
    near = Ladder(near=4).table["target"]
    compass = Ladder(actions="compass").table["target"]
    worst, best = (f(compass[row] for row in names) for f in (min, max))
    yield [
        "from 5 to 4",
        f"{near['grad']:.1f}",
        f"{near['prob']:.1f}",
        f"{best:.1f}",
        f"{worst:.1f}",
    ]


def page_08():
    """Both ends of the length of advice, the paper's marks, and other guides."""
    grid = at.experiments.read_results("goal-target-tau")
    short, long = (grid.totals("nd-hard", tau).mean() for tau in (500_000, 25_000_000))
    yield [
        "0.5 million",
        f"{short / 1000:.0f} thousand",
        "25 million",
        f"{long / 1000:.0f}",
    ]
    best = {tuned.name: tuned for tuned in at.experiments.tune(grid)}
    hard, soft = best["nd-hard"], best["nd-soft"]
    assert hard.best == hard.paper
    yield [f"{t / 1e6:g} million" for t in (hard.best, soft.best, soft.paper)]
    others = [best[f"{guide}-hard"].best for guide in ("prob", "grad")]
    assert others == [hard.best] * 2
    yield [f"{best['rand-hard'].best / 1e6:g} million", f"{hard.best / 1e6:g}"]


def page_09():
    """Runs that claim 1 needs, two widths, and an arm against itself."""
    scene = Filling()
    claim, same = scene.reading("1"), scene.reading("same")
    assert set(claim.stops) == {claim.settled}
    yield [f"{claim.settled} runs"]
    totals = at.experiments.read_results(scene.results).totals("nd-hard")
    wide = {}
    for n in (10, 50):
        interval = at.experiments.stats.t_interval(totals[:n])
        box = np.subtract(*np.percentile(totals[:n], [75, 25]))
        wide[n] = [(interval.high - interval.low) / 1000, box / 1000]
    yield [
        "10 runs",
        f"{wide[10][0]:.1f} thousand",
        "50",
        f"{wide[50][0]:.1f}",
        f"from {wide[10][1]:.1f} to {wide[50][1]:.1f}",
    ]
    signed = [stop for stop in same.stops if stop is not None]
    yield [
        f"{len(signed)} of the {len(same.stops)} comparisons",
        f"run {min(signed)}",
    ]


def page_10():
    """Driving, three places of the dial, the other reward; then three operations."""
    dial = Dial()
    betas = np.arange(0, 8.25, 0.25)
    drives = [dial.driving(beta) for beta in betas]
    top = betas[np.argmax(drives)]
    yield [f"{top:g}", f"{max(drives):.1f}", f"{drives[4]:.1f}", f"{drives[0]:.1f}"]
    places = (0, 1, 8)
    goals = [dial.teaching(beta) for beta in places]
    assert goals == sorted(goals, reverse=True)
    yield [f"{n / 1000:.0f} thousand" for n in goals]
    poor = [Dial(reward="cost").teaching(beta) for beta in places]
    assert poor == sorted(poor, reverse=True)
    yield [f"{n:,}" for n in poor]
    scene = Surgery()
    asked = [("nd", "none"), ("nd", "erase"), ("prob", "none"), ("prob", "graft")]
    asked += [("nd", "deal"), ("nd", "thin")]
    found = (goals.sum() for goals in scene.goals_of(asked))
    nd, erased, prob, grafted, dealt, thinned = found
    assert prob < thinned < dealt < grafted < nd
    left = (erased - prob) / (nd - prob)
    yield [f"{100 * left:.0f} %", *(f"{n / 1000:.0f}" for n in (nd, erased, prob))]
    yield [f"{grafted / 1000:.0f} thousand"]
    yield [f"{dealt / 1000:.0f} and {thinned / 1000:.0f} thousand"]


def page_11():
    """When two robots wake, the sizes of a whisper, and what exists."""
    scene = Whisper()
    asked = [*(("values", power) for power in POWERS), ("exists", 9)]
    whispered = dict(zip(asked, scene.goals_of(asked), strict=True))
    quiet, advised = whispered["values", 9], scene.goals("advice")
    woke = [first(goals > 5000) * 0.5 for goals in (quiet, advised)]
    yield ["5,000 goals", *(f"{x:g} million" for x in woke), "3.5 million"]
    totals = {power: whispered["values", power].sum() for power in POWERS}
    assert list(totals.values()) == sorted(totals.values())
    thousands = [f"{totals[power] / 1000:.0f} thousand" for power in (0, 40)]
    none, exists = scene.goals("none").sum(), whispered["exists", 9].sum()
    yield ["Size 1", *thousands, f"{none / 1000:.0f}"]
    others = (advised.sum(), quiet.sum())
    yield [f"{exists / 1000:.0f} thousand", *(f"({n / 1000:.0f})" for n in others)]


def page_12():
    """Who drives and who teaches best in the school, one more door, fewer features."""

    def over_none(scene):
        goals = scene.run().goals
        return {
            name: 100 * (goals[name].mean() / goals["none"].mean() - 1)
            for name in goals
        }

    school = Project()
    table = at.executed_values(
        at.navigation_tasks(school.map),
        at.abstract_policies(at.navigation_tasks(at.read_map("source"))),
    )
    drives, gains = {n: table[n] for n in ("nd", "prob", "grad")}, over_none(school)
    assert max(drives, key=drives.get) == "prob"
    assert max(gains, key=gains.get) == "eager"
    yield [f"{drives['prob']:.1f}", f"{gains['eager']:+.1f} %"]
    door = over_none(Project(map=school.map.add_door((2, 4), "S")))
    more = {name: door[name] - gains[name] for name in drives}
    assert max(more, key=more.get) == "prob"
    yield [
        f"from {gains['prob']:.1f} to {door['prob']:.1f} %",
        f"from {gains['eager']:+.1f} to {door['eager']:+.1f} %",
    ]
    features = [name for name in at.FEATURES if "near" not in name]
    yield [f"{over_none(Project(features=features))['nd']:+.1f} %"]


SEEN = {name[5:]: made for name, made in dict(globals()).items() if "page_" in name}
