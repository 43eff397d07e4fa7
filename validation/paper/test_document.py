"""docs/paper.md: every command it quotes runs, names a claim that exists, and every claim is quoted."""
import os
import re
import shlex
import subprocess
import unittest

from claims import CLAIMS
from program import BINARY, ROOT

TEXT = (ROOT / "docs/paper.md").read_text(encoding="utf-8")
COMMANDS = sorted(set(re.findall(r"`((?:impact-pair|validation/paper/run|cargo)\b[^`]*)`", TEXT)))
# Without these words of the environment all commands are run, those that search for bases for a minute as well.
IS_QUICK = "PAPER_QUICK" in os.environ
# Lower bounds of the entropy per impact, and where given per forcing period.
BOUNDS = re.findall(r"entropy (?:at least )?\$(\d\.\d+)\$(?: per impact and \$(\d\.\d+)\$ per forcing period)?", TEXT)
ENTROPIES = {value for bound in BOUNDS for value in bound if value}


class Document(unittest.TestCase):
    """The commands in back quotes."""

    def test_claims_and_document_name_each_other(self):
        quoted = {word for command in COMMANDS if command.startswith("validation/paper/run")
                  for word in command.split()[1:] if not word.startswith("-")}
        self.assertEqual(quoted, set(CLAIMS))

    def test_commands_of_the_program_are_certified(self):
        searches = [command for command in COMMANDS if command.startswith("impact-pair chaos ") and "--bases" not in command]
        runs = [command for command in COMMANDS if command.startswith("impact-pair ") and not (IS_QUICK and command in searches)]
        self.assertTrue(runs)
        proved = []
        for command in runs:
            with self.subTest(command=command):
                arguments = shlex.split(command)[1:]
                self.assertIn(arguments[0], ("run", "two-impact", "trap", "chaos", "cycles", "check"))
                done = subprocess.run([BINARY, *arguments, "--quiet"], cwd=ROOT, capture_output=True, text=True,
                                      check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                for certified in re.findall(r"topological entropy is at least (.*)", done.stdout):
                    proved += re.findall(r"\d\.\d+", certified)
        self.assertTrue(proved)
        for value in () if IS_QUICK else ENTROPIES:
            self.assertTrue([entropy for entropy in proved if entropy.startswith(value)], f"{value} of {proved}")

    def test_entropies_are_given(self):
        self.assertGreaterEqual(len(ENTROPIES), 8, "the words around them have changed")

    def test_no_other_command_is_quoted(self):
        self.assertFalse([command for command in COMMANDS if command.startswith("cargo")
                          and command != "cargo run --release --"])

    def test_links_exist(self):
        for link in re.findall(r"\]\(([^)#:]+)\)", TEXT):
            self.assertTrue(os.path.exists(ROOT / "docs" / link), link)


if __name__ == "__main__":
    unittest.main()
