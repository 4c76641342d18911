"""The C loop of ``loop.c``, compiled here where there is a compiler."""

import ctypes
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).with_name("loop.c")
FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")


class Run(ctypes.Structure):
    """The struct of the same name in ``loop.c``."""

    _fields_ = [
        *((name, ctypes.c_void_p) for name in ("next", "row", "start", "cum")),
        *((name, ctypes.c_void_p) for name in ("reward", "guide", "terminal")),
        *((name, ctypes.c_int64) for name in ("n_start", "tau", "max_episode", "hard")),
        *((name, ctypes.c_double) for name in ("alpha", "epsilon", "gamma")),
        ("q", ctypes.c_void_p),
        ("word", ctypes.c_uint64 * 4),
        *((name, ctypes.c_int64) for name in ("s", "length", "goals")),
    ]


def compiled_loop():
    """Return the function ``learn``, or None where there is no C compiler."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        return None
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "loop.so"
        subprocess.run([compiler, *FLAGS, str(SOURCE), "-o", str(library)], check=True)
        learn = ctypes.CDLL(str(library)).learn
    learn.argtypes = (ctypes.POINTER(Run), ctypes.c_int64, ctypes.c_int64)
    learn.restype = None
    return learn


def new_run(settings, seed: int) -> tuple[Run, dict[str, np.ndarray]]:
    """Return a run with these settings, and the arrays it points to: keep them."""
    mdp, guide = settings.mdp, settings.guide
    rows, row = np.zeros((1, mdp.n_actions)), np.zeros(mdp.n_states)
    if guide is not None:
        rows, row = np.unique(guide, axis=0, return_inverse=True)
    arrays = {
        "next": mdp.next_state.astype(np.int32),
        "row": row.astype(np.int32),
        "start": settings.start.astype(np.int32),
        "cum": np.cumsum(mdp.prob, axis=2),
        "reward": mdp.reward.copy(),
        "guide": np.cumsum(rows, axis=1),
        "terminal": mdp.terminal.astype(np.uint8),
        "q": np.array(settings.q0),
    }
    words = np.random.SeedSequence(seed).generate_state(4, np.uint64)
    run = Run(
        **{name: array.ctypes.data for name, array in arrays.items()},
        n_start=len(settings.start),
        tau=settings.tau,
        max_episode=settings.max_episode,
        hard=settings.strategy == "hard",
        alpha=settings.alpha,
        epsilon=settings.epsilon,
        gamma=settings.gamma,
        word=(ctypes.c_uint64 * 4)(*words.tolist()),
        s=int(settings.start[0]),
    )
    return run, arrays
