"""Examples of docstrings, `>>> ...`, are shown as code in the manual: an extension of griffe, which reads the package."""
import re

import griffe

EXAMPLE = re.compile(r"^>>> .*(?:\n.+)*", re.M)


def fence(obj):
    """Of an object and what is in it."""
    if obj.docstring:
        obj.docstring.value = EXAMPLE.sub(r"```pycon\n\g<0>\n```", obj.docstring.value)
    for member in obj.members.values():
        if not member.is_alias:
            fence(member)


class Doctests(griffe.Extension):
    def on_package(self, *, pkg, **_):
        fence(pkg)
