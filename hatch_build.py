"""Bundle the scripts of the scenes whenever the package is built or installed."""

import importlib.util
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


def _bundler(root):
    """Load the module that bundles by itself: what the package needs is not here."""
    path = Path(root, "abstransfer", "scenes", "bundle.py")
    spec = importlib.util.spec_from_file_location("bundle", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Bundles(BuildHookInterface):
    """Every wheel carries the bundles; so does the source archive."""

    def dependencies(self):
        """Return what a build needs beside hatchling: nothing if nothing is to do."""
        return [] if _bundler(self.root).is_fresh() else ["deno>=2.9,<2.10"]

    def initialize(self, version, build_data):
        """Bundle; a wheel without its scenes is refused, an own checkout is not."""
        bundler = _bundler(self.root)
        try:
            bundler.build()
        except bundler.BundleError as error:
            if version != "editable":
                raise
            self.app.display_warning(f"the scenes will not show: {error}")
