#!/usr/bin/env python3
"""Follows every link of the built manual, and of every page on disk, that stays here; fails at one that leads nowhere.

    docs/links.py FOLDER

Pages on disk are those that git knows of; of them files are looked for, of the manual the places in pages as well.
"""
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parent.parent
WRITTEN = re.compile(r"\]\(([^()\s]+)\)|(?:src|href)=\"([^\"]+)\"")
FENCED = re.compile(r"^```.*?^```", re.M | re.S)


class Page(HTMLParser):
    """Where a page leads, and the names of its places."""

    def __init__(self, file):
        super().__init__()
        self.links, self.names = set(), {""}
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if key in ("href", "src") and value:
                self.links.add(value)
            if key in ("id", "name") and value:
                self.names.add(value)


def stays(link):
    parts = urlsplit(link)
    return not parts.scheme and not parts.netloc and not link.startswith("data:")


def of_manual(folder):
    pages = {file: Page(file) for file in folder.rglob("*.html") if file.name != "404.html"}
    count = 0
    for file, page in pages.items():
        for link in filter(stays, page.links):
            parts, count = urlsplit(link), count + 1
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            target = target / "index.html" if target.is_dir() else target
            if not target.exists() or (target in pages and unquote(parts.fragment) not in pages[target].names):
                yield f"{file.relative_to(folder)}: {link}"
    print(f"manual: {len(pages)} pages, {count} links followed")


def on_disk():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in listed.stdout.split():
        text = FENCED.sub("", (ROOT / name).read_text(encoding="utf-8"))
        for link in filter(stays, (one or other for one, other in WRITTEN.findall(text))):
            path = urlsplit(link).path
            if path and not ((ROOT / name).parent / path).exists():
                yield f"{name}: {link}"


def main():
    dead = [*of_manual(Path(sys.argv[1]).resolve()), *on_disk()]
    if dead:
        sys.exit("error: links that lead nowhere:\n" + "\n".join(dead))


if __name__ == "__main__":
    main()
