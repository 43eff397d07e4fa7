"""What mkdocs does besides: pages and files of the repository outside of docs/, and their links.

README.md is the first page; the others have the place repository/PATH. A link that is right on disk is right in the manual: to a
page or a file of the manual it leads there, to anything else of the repository it is said in words. The notebooks are pages too, with
their outputs where python/test has executed them as they are.
"""
import importlib.util
import json
import os
import posixpath
import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
OUTSIDE = ["README.md", "CONTRIBUTING.md", "DESIGN.md", "CHANGELOG.md", "SECURITY.md", "CITATION.cff", "LICENSE-*", "python/README.md", "data/README.md", "python/notebooks/*.ipynb", "scenes/*.toml",
           "validation/README.md", "validation/*/README.md", "validation/report/*.md", "validation/report/*.svg"]
LINK = re.compile(r'\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s:#]+)(#[^()\s]*)?\)')
# Pictures of a given width, as the gallery has them.
PICTURE = re.compile(r'(<img src=")([^":]+)(")')
# Lists and formulas that begin right below a sentence: Python's Markdown asks for an empty line.
LIST = re.compile(r"^((?![-*\s|>]).+)\n(?=- )", re.M)
FORMULA = re.compile(r"^(\$\$.+?\$\$)$", re.M | re.S)


def place(path):
    """Where a file of the repository is in the manual."""
    if path == "README.md":
        return "index.md"
    if path.endswith(".ipynb"):
        return f"notebooks/{Path(path).stem}.md"
    return path.removeprefix("docs/") if path.startswith("docs/") else f"repository/{path}"


def on_files(files, config):
    for path in sorted({str(found.relative_to(ROOT)) for pattern in OUTSIDE for found in ROOT.glob(pattern)}):
        files.append(File.generated(config, place(path), abs_src_path=str(ROOT / path)))
    mathjax = Path(importlib.util.find_spec("mathjax").origin).parent / "static/mathjax/es5/tex-svg.js"
    files.append(File.generated(config, "mathjax/tex-svg.js", abs_src_path=str(mathjax)))
    return files


def on_page_read_source(page, config):
    path = Path(page.file.abs_src_path or "")
    return as_markdown(path) if path.suffix == ".ipynb" else None


def as_markdown(path):
    """A notebook's cells, with the outputs of target/notebooks if those are of the same cells."""
    cells, executed = cells_of(path), ROOT / "target/notebooks" / path.name
    done = cells_of(executed) if executed.exists() else []
    is_same = [cell["source"] for cell in done] == [cell["source"] for cell in cells]
    said = "with the outputs of a run" if is_same else "without outputs"
    parts = []
    for cell in done if is_same else cells:
        if cell["cell_type"] == "markdown":
            parts.append(cell["source"])
        else:
            parts += [f"```python\n{cell['source']}\n```", *filter(None, map(shown, cell["outputs"]))]
    parts.insert(1, f"*This page is the notebook `{path.relative_to(ROOT)}`, {said}. `python/test` executes it.*")
    return "\n\n".join(parts)


def cells_of(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell | {"source": "".join(cell["source"])} for cell in cells]


def shown(output):
    """An output as Markdown: a picture or a text; of a stream what is no warning."""
    data = output.get("data", {"text/plain": output["text"] if output.get("name") == "stdout" else ""})
    if "image/png" in data:
        return f'<img alt="What the cell above draws" src="data:image/png;base64,{"".join(data["image/png"]).strip()}">'
    text = "".join(data.get("text/plain", "")).rstrip()
    return text and f"```text\n{text}\n```"


def on_page_markdown(markdown, page, config, files):
    here = posixpath.dirname(page.file.src_uri)
    on_disk = os.path.relpath(page.file.abs_src_path or "", ROOT)

    def led(match):
        words, target, anchor = match[1], match[2], match[3] or ""
        path = posixpath.normpath(posixpath.join(posixpath.dirname(on_disk), target))
        if not (ROOT / path).exists():
            return match[0]
        if files.get_file_from_path(place(path)) is None:
            return words if "`" in words or words.startswith("![") else f"`{words}`"
        return f"[{led_within(words)}]({posixpath.relpath(place(path), here or '.')}{anchor})"

    def led_within(words):
        return LINK.sub(led, words)

    def pictured(match):
        path = posixpath.normpath(posixpath.join(posixpath.dirname(on_disk), match[2]))
        if path.startswith("docs/") or files.get_file_from_path(place(path)) is None:
            return match[0]
        # A page lies in its folder, as on disk: HTML is not led by mkdocs.
        return match[1] + posixpath.relpath(place(path), here or ".") + match[3]

    return PICTURE.sub(pictured, LINK.sub(led, FORMULA.sub(r"\n\1\n", LIST.sub(r"\1\n\n", markdown))))


def on_post_page(output, page, config):
    """The theme would fetch a stand-in for the search's worker from elsewhere; ours is search.js."""
    return re.sub(r'<script src="https://[^"]*iframe-worker[^"]*"></script>', f'<script src="{posixpath.relpath("search.js", posixpath.dirname(page.url) or ".")}"></script>', output)
