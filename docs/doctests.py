"""Examples of docstrings, `>>> ...`, and names, :class:`Scene`, are shown as code in the manual: an extension of griffe, which reads
the package. What stands below the heading Examples griffe shows as code itself."""
import re

import griffe

ROLE = re.compile(r":(?:class|func|meth|mod):`([^`]+)`")
EXAMPLE = re.compile(r"^>>> .*(?:\n.+)*", re.M)


def fence(obj):
    """Of an object and what is in it."""
    if obj.docstring:
        said, heading, examples = obj.docstring.value.partition("\nExamples\n--------\n")
        obj.docstring.value = ROLE.sub(r"`\1`", EXAMPLE.sub(r"```pycon\n\g<0>\n```", said) + heading + examples)
    for member in obj.members.values():
        if not member.is_alias:
            fence(member)


class Doctests(griffe.Extension):
    def on_package(self, *, pkg, **_):
        fence(pkg)
