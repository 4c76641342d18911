"""Fixtures of the tests of scenes."""

from run_scenes import show
from scene_pages import at_scenes, scene_pages
from scene_tab import all_scenes, open_scene

__all__ = ["all_scenes", "at_scenes", "open_scene", "scene_pages", "show"]
