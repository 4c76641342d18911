"""
How the tests run: in what order, what nbval compares of the pages, how it speaks to
their kernels, and for how long it waits.

What was loaded and collected stays to the end: Python need not look there for garbage.
"""

import gc
from itertools import chain, groupby, zip_longest
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp

import nbval.kernel
from jupyter_client.manager import KernelManager
from nbval.plugin import IPyNbCell
from support import spoken_by_files

# nbval leaves these out; a second run gives them too.  What stays out: the random names
# of widgets, which the stored pages lack.
COMPARED = {"metadata", "traceback", "name", "output_type"}
# Seconds until a message of the kernel must be there.  nbval gives up after 5, which a
# busy machine may take.
PATIENCE = 1000

SCENES = Path(__file__).parent / "tests" / "scenes"

gc.disable()  # until all is collected


class FileKernel(KernelManager):
    """A kernel of nbval's, with a folder of its own."""

    def __init__(self, **traits):
        self.folder = mkdtemp()
        super().__init__(**traits, **spoken_by_files(self.folder))

    def shutdown_kernel(self, **how):
        super().shutdown_kernel(**how)
        rmtree(self.folder)


nbval.kernel.KernelManager = FileKernel


def pytest_collection_modifyitems(items):
    """Let scenes, which often wait for their browser, take turns with what computes."""
    files = [list(tests) for _, tests in groupby(items, key=lambda item: item.path)]
    of_scenes = [each for each in files if each[0].path.parent == SCENES]
    others = [each for each in files if each[0].path.parent != SCENES]
    turns = zip_longest(of_scenes, *(others[i::4] for i in range(4)), fillvalue=())
    items[:] = chain.from_iterable(chain.from_iterable(turns))
    for item in items:
        if isinstance(item, IPyNbCell):
            item.output_timeout = PATIENCE
            page = item.parent
            page.skip_compare = tuple(set(page.skip_compare) - COMPARED)


def pytest_collection_finish():
    gc.freeze()
    gc.enable()
    gc.set_threshold(50_000, 20, 20)
