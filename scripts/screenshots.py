"""
Take pictures of every built page: wide and narrow, light and dark.

    python scripts/screenshots.py FOLDER [PAGE ...]

Build the book first.  The pictures are named page-width-colour.png.
"""

from __future__ import annotations

import argparse
import sys
from itertools import product
from pathlib import Path

from playwright.sync_api import sync_playwright

from abstransfer.cli.doctor import check_browser

HTML = Path(__file__).parents[1] / "build" / "_build" / "html"
WIDTHS = (1440, 400)
COLORS = ("light", "dark")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.strip().split("\n")[0])
    parser.add_argument("folder", type=Path, help="where the pictures go")
    parser.add_argument("pages", nargs="*", help="default: all")
    options = parser.parse_args()
    browser = check_browser()
    pages = options.pages or sorted(page.stem for page in HTML.glob("[!gs]*.html"))
    if not browser.ok or not pages:
        print(browser.remedy or "the book is not built; run: make book")
        return 1
    options.folder.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(
            executable_path=browser.found, args=["--no-sandbox", "--disable-gpu"]
        )
        for width, color in product(WIDTHS, COLORS):
            size = {"width": width, "height": 900}
            tab = chromium.new_page(viewport=size, color_scheme=color)
            for page in pages:
                tab.goto((HTML / f"{page}.html").as_uri())
                tab.wait_for_timeout(1500)  # formulas are drawn after loading
                target = options.folder / f"{page}-{width}-{color}.png"
                tab.screenshot(path=target, full_page=True)
                print(target)
            tab.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
