"""How nbval compares the pages: all of an output, by one worker, however busy it is."""

import pytest
from nbval.plugin import IPyNbCell

# nbval leaves these out; a second run gives them too.  What stays out: the random names
# of widgets, which the stored pages lack.
COMPARED = {"metadata", "traceback", "name", "output_type"}
PATIENCE = 120  # seconds for a message; nbval gives up after 5, too few on a busy machine


def pytest_collection_modifyitems(items):
    for item in items:
        if isinstance(item, IPyNbCell):
            item.output_timeout = PATIENCE
            page = item.parent
            page.skip_compare = tuple(set(page.skip_compare) - COMPARED)
            item.add_marker(pytest.mark.xdist_group(page.path.name))
