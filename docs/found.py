#!/usr/bin/env python3
"""Fails where the search of the built manual does not find the page that explains a word, or a page begins with something else.

    docs/found.py FOLDER

A word in a title counts a thousand times as much as one in a text: the index says so, and the first page is one whose title has it.
"""
import json
import re
import sys
from pathlib import Path

#: What readers look for, and where it is explained.
EXPLAINED = {
    "Lyapunov": "howto/exponents.html",
    "basins": "gallery/basins.html",
    "bifurcations": "howto/bifurcations.html",
    "chatter": "howto/chatter.html",
    "horseshoe": "gallery/horseshoe.html",
    "sweeps": "howto/sweeps.html",
}
#: What a page begins with.
FIRST = {"reference/python.html": "impact_pair.solve"}


def main():
    index = json.loads((Path(sys.argv[1]) / "search/search_index.json").read_text(encoding="utf-8"))
    assert index["config"]["fields"]["title"]["boost"] >= 1000 * index["config"]["fields"]["text"]["boost"]
    wrong = []
    for word, page in EXPLAINED.items():
        titled = [entry["location"] for entry in index["docs"] if word.lower() in entry["title"].lower()]
        # Headings of other pages may have the word as well, but no more of them than a reader looks through.
        if page not in [location.partition("#")[0] for location in titled] or len(titled) > 8:
            wrong.append(f"{word}: {page} is not among the titles found, {titled}")
    for page, first in FIRST.items():
        found = re.search(r'<h[23] id="([^"]*)"', (Path(sys.argv[1]) / page).read_text(encoding="utf-8"))
        if not found or found[1] != first:
            wrong.append(f"{page} begins with {found and found[1]}, not with {first}")
    print("\n".join(wrong) or f"search: {len(EXPLAINED)} words lead to their pages")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
