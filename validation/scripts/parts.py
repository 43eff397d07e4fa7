#!/usr/bin/env python3
"""The parts of the validation suite: what each runs, on what it waits, and what it does in small and in full.

Two parts run at a time, of those that use cargo one: it uses all cores itself. A part that has passed is not run again until a file that
it reads has changed, or a tool. On failure the last lines are shown, and the command that runs the part alone.
"""
import argparse
import contextlib
import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import namedtuple
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve()
STATE = ROOT / "target" / "validation-parts"
# One profile for tests, truth and command line: optimised, with the checks of a debug build.
PROFILE = ["--profile", "validation"]
PROGRAM = TARGET / "validation" / "impact-pair"
TAIL = 40
# Seconds after which a part has failed; ten times as many in full.
PATIENCE = 2700
# Of OCaml's programs, Coq above all: a small heap of young values, collected seldom, takes a quarter less processor time.
OCAML = "s=1M,o=1000"
# Versions of tools: a change lets all parts run again.
TOOLS = subprocess.run("rustc --version; coqc --version; ocamlopt -version; gappa --version", shell=True, capture_output=True, text=True, check=False).stdout + sys.version
# The running processes: stopped when another part fails, or the user interrupts.
RUNNING = set()

# `small` and `full` are shell commands; `inputs` are the files and folders whose bytes decide whether it has to run again.
Part = namedtuple("Part", "name small full after cargo inputs", defaults=((), False, (".",)))
# The files that the program is built from.
SOURCES = ("Cargo.toml", "Cargo.lock", ".cargo", "src", "crates", "cli", "scenes")


def cargo(name, small, full=None, after=()):
    return Part(name, small, full or small, after, True)


def by_program(name, *read):
    """A folder of validation/ that judges the program, and writes a page of the report."""
    command, inputs = f"validation/{name}/run", (*SOURCES, "validation/requirements.txt", f"validation/{name}", *read)
    return Part(name, f"{command} --quick --report $REPORT", f"{command} --report $REPORT", ("program", "python"), False, inputs)


# Cargo builds the library anew for each choice of packages and features: the same one everywhere, so that it is built once.
GMP = subprocess.run([ROOT / "validation/gmp"], check=True, capture_output=True, text=True).stdout.strip()
ALL = f"{' '.join(PROFILE)} --workspace {GMP}"
TEST = f"cargo test {ALL}"
# Runs the tests of all executables side by side, where it is there.
QUICK = f"cargo nextest run --cargo-profile validation --workspace {GMP} --tests --no-fail-fast --status-level fail" if shutil.which("cargo-nextest") else f"{TEST} --tests"
LINT = f"cargo clippy {' '.join(PROFILE)} {GMP} --workspace"
# By default clippy's driver, where it is on the path, compiles the workspace: what is built is linted, and nothing is checked a second time.
LINTED = {"RUSTC_WORKSPACE_WRAPPER": "clippy-driver", "CLIPPY_ARGS": "-D__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__"} if shutil.which("clippy-driver") else {}
TARGETS = "--lib --bins --examples --tests"
# Lines that ruff refuses half an hour later, in the package.
FORM = "cargo fmt --all --check && ! awk 'length > 140 { print FILENAME \":\" FNR \": more than 140 characters\" }' $(git ls-files 'python/*.py') | grep ."
NO_C = "cargo tree --quiet --edges normal,build,dev --prefix none -p impact-pair -p impact-pair-cli"
NO_C = f"! {NO_C} | grep -E '^(cc|gmp-mpfr-sys|cmake|bindgen) '"
MANY = "IMPACT_PAIR_MULTIPLIER=40 FUZZ_CASES=${FUZZ_CASES:-100000}"
FRESH = "STRADDLE_CASES=${STRADDLE_CASES:-100000} STRADDLE_SEED=fresh"
CROSSED = "CROSSINGS_CASES=${CROSSINGS_CASES:-100000} CROSSINGS_SEED=fresh"

# Those of the folder that prove something in a second.
EXAMPLES = ("events", "impact_map", "symmetry_lost")
BUILT = " ".join(f"--example {name}" for name in (*EXAMPLES, "instructions"))
RUN_EXAMPLES = f'for example in {" ".join(EXAMPLES)}; do "${{IMPACT_PAIR%/*}}/examples/$example" >/dev/null || exit 1; done'
# A README that is read: at most 150 lines of at most 120 characters.
MANUAL = "! awk 'NR > 150 || length > 120' README.md | grep . && docs/reference/make --check && docs/manual"

# Of those that are ready the first ones begin: the program, on which most wait, then what Coq compiles beside it.
PARTS = [
    cargo("formatting", FORM),
    cargo("program", f"cargo build {ALL} --bin impact-pair {BUILT}", after=("formatting",))._replace(inputs=()),
    Part("library", *2 * ("validation/coq/library",), inputs=("validation/coq",)),
    Part("python", *2 * ("validation/scripts/environment",), inputs=()),
    Part("kernel", "validation/kernel/prove --quick", "validation/kernel/prove", inputs=("src/number/kernel.rs", "validation/kernel", "validation/scripts/proving.py")),
    Part("bounds", "validation/bounds/prove --quick", "validation/bounds/prove",
         inputs=("src/number", "src/contact", "src/flight.rs", "validation/bounds", "validation/scripts/proving.py")),
    cargo("tests", QUICK,
          f"{MANY} {TEST} --features png,pdf,parquet --lib --bins --tests -- --include-ignored && {TEST} --doc"
          f" && cargo test {' '.join(PROFILE)} -p impact-pair -p impact-pair-tests -p impact-pair-cli --no-default-features"
          f" && {TEST} --benches && {FRESH} {TEST} --test library straddle:: -- --nocapture"
          f" && {CROSSED} {TEST} --test truth crossings:: -- --nocapture && CORPUS_CASES=${{CORPUS_CASES:-10}} {TEST} --test library corpus::"
          f" && PROPTEST_CASES=100000 CORPUS_CASES=all {TEST} --test recorded", ("program",)),
    # After the tests it is the other examples that are left to build.
    cargo("lints", f"cargo build {ALL} {TARGETS}" if LINTED else f"{LINT} {TARGETS} -- -D warnings",
          f"{LINT} --all-targets -- -D warnings && {LINT} --all-targets --features png,pdf,parquet -- -D warnings"
          f" && cargo clippy {' '.join(PROFILE)} --all-targets -p impact-pair -p impact-pair-cli --no-default-features -- -D warnings", ("tests",)),
    cargo("no C", NO_C, NO_C, after=("lints",)),
    cargo("dependent", "validation/scripts/dependent --quick", "validation/scripts/dependent", after=("lints",)),
    cargo("commands", "validation/scripts/commands", after=("lints",)),
    # Benches have no examples, and criterion is built for nothing else.
    cargo("documentation", f"RUSTDOC=$PWD/validation/scripts/rustdoc {TEST} --doc --exclude impact-pair-benches",
          f"RUSTDOCFLAGS='-D warnings' cargo doc {ALL} --no-deps --quiet", ("lints",)),
    cargo("instructions", "validation/scripts/instructions --profile validation", "validation/scripts/instructions", after=("tests",)),
    Part("scenes", *2 * (f'for scene in scenes/*.toml; do "$IMPACT_PAIR" run "$scene" --quiet --format csv >/dev/null || exit 1; done; {RUN_EXAMPLES}',),
         ("program",), inputs=(*SOURCES, "examples")),
    Part("gallery", "docs/gallery/make --check --quick", "docs/gallery/make --check", ("program",), inputs=(*SOURCES, "docs")),
    Part("stability", *2 * ("docs/stability/make --check",), ("program",), inputs=(*SOURCES, "docs")),
    Part("manual", f"{MANUAL} && validation/scripts/transcripts", f"{MANUAL} && validation/scripts/transcripts --full", ("program", "python")),
    *map(by_program, ["arb", "closed_forms", "references", "certificates"]),
    by_program("coq")._replace(after=("program", "library")),
    # The corpus of documents is written by the tests.
    by_program("coq/verified", "validation/coq", "tests/corpus", "crates/certificate/tests")._replace(name="verified", after=("program", "library", "tests")),
    by_program("paper", "docs"),
    by_program("audits", "validation/references"),
    Part("data", *2 * ('"$(validation/scripts/environment)" data/make --check && "$(validation/scripts/environment)" -m unittest discover -s data',),
         ("program", "python"), False, (*SOURCES, "data", "validation/references", "validation/requirements.txt")),
    cargo("package", "python/test", "python/test --full", ("lints", "verified")),
    cargo("mutations", "validation/scripts/mutations --quick --report $REPORT", "validation/scripts/mutations --report $REPORT",
          ("tests", "python", "instructions")),
]


# The folders of the crates for `--fast`, and the tests that run for what has changed, by the name of their executable.
CRATES = {"src": "impact-pair", "cli": "impact-pair-cli", "fuzz": "impact-pair-fuzz", "validation/truth": "impact-pair-truth",
          **{f"crates/{name}": f"impact-pair-{name}" for name in ("certificate", "document", "exact", "model", "plot")}}
LIBRARY = {"src", "crates/exact", "crates/model"}
CHECKER = {"crates/certificate", "crates/document", "crates/exact", "crates/model"}
COMMANDS = {"cli", "crates/answers", "crates/plot", "docs/schemas", *CHECKER, *LIBRARY}
PYTHON = "validation/scripts/venv target/python-venv python/requirements.txt && PATH=$PWD/target/python-venv/bin:$PATH && ruff check --quiet python && ruff format --quiet --check python && cd python && mypy"


def changed():
    """Files that differ from main, or, on main, from the last commit."""
    git = lambda *words: subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    main = git("rev-parse", "--verify", "--quiet", "main").strip() if git("branch", "--list", "main") else "HEAD"
    base = git("merge-base", main, "HEAD").strip()
    return {*git("diff", "--name-only", base).split(), *git("ls-files", "--others", "--exclude-standard").split()}


def fast_parts():
    """Formatting, what the compiler says, and the tests that concern the change since main."""
    files = changed()
    parts = [cargo("formatting", FORM)._replace(inputs=())]
    if any(file.startswith("python/") for file in files):
        parts.append(Part("python", *2 * (PYTHON,), inputs=()))
    touched = {folder for folder in (*CRATES, "docs/schemas") if any(file.startswith(f"{folder}/") for file in files)}
    wanted = [f"package({CRATES[folder]}) & kind(lib)" for folder in sorted(touched & set(CRATES))]
    targets = ["--lib"] * bool(wanted)
    for folders, executable, tests in [
        (LIBRARY, "library", "/^(arrows|labels|soundness)::/"),
        (LIBRARY, "truth", "/^crossings::no_answer/"),
        (CHECKER, "recorded", "/every_value/"),
        (COMMANDS, "cli", "/^(audit|certificates|output|periodic|plot|run|schemas|two_impact)::|^help::every_verb/"),
    ]:
        if touched & folders:
            targets.append(f"--test {executable}")
            wanted.append(f"binary({executable}) & test({tests})")
    if wanted:
        chosen = " | ".join(f"({one})" for one in wanted)
        # Incremental: a change of a line is not a build of the library; in files of their own, beside those of all other parts.
        tests = (f"CARGO_INCREMENTAL=1 CROSSINGS_CASES=${{CROSSINGS_CASES:-300}} cargo nextest run --cargo-profile validation --workspace {GMP}"
                 f" {' '.join(targets)} --status-level fail -E '{chosen}'")
        if not shutil.which("cargo-nextest"):
            tests = f"{TEST} --lib && {TEST} --test library soundness:: && {TEST} --test cli run::"
        parts.append(cargo("tests", tests)._replace(inputs=()))
    return parts


def stamp(part, full):
    """A file that is there once the part has passed with these inputs and tools; the full run is whole, and so is one of tests of one's own."""
    if full or not part.inputs or any(name.endswith(("_CASES", "_SEED", "_MULTIPLIER")) for name in os.environ):
        return None
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", *part.inputs, "validation/scripts/parts.py"]
    names = subprocess.run(listed, cwd=ROOT, check=True, capture_output=True).stdout.split(b"\0")
    digest = hashlib.sha256(TOOLS.encode())
    for name in sorted(filter(None, names)):
        file = ROOT / os.fsdecode(name)
        if file.is_file():
            digest.update(name + b"\0" + file.read_bytes())
    return STATE / f"{part.name.replace(' ', '-')}-{digest.hexdigest()[:16]}"


def run(part, full, environment):
    """(exit code, (seconds, seconds of processor time), what it wrote, whether it had passed before)"""
    passed = stamp(part, full)
    if passed and passed.exists():
        return 0, (0.0, 0.0), None, True
    log, began = STATE / f"{part.name.replace(' ', '-')}.log", time.monotonic()
    with log.open("wb") as out:
        limit = ["timeout", "--verbose", str(PATIENCE * (10 if full else 1))]
        command = [*limit, "bash", "-o", "pipefail", "-c", part.full if full else part.small]
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out, start_new_session=True)
        RUNNING.add(process.pid)
        _, status, usage = os.wait4(process.pid, 0)
        RUNNING.remove(process.pid)
        code = process.returncode = os.waitstatus_to_exitcode(status)
    if code == 0 and passed:
        passed.touch()
    return code, (time.monotonic() - began, usage.ru_utime + usage.ru_stime), log, False


def report_line(part, code, seconds, log, before):
    """A line of the part; on failure its end as well."""
    took, worked = seconds
    state = "unchanged since it passed" if before else f"{'passed' if code == 0 else 'FAILED'} {took:5.0f} s, {worked:5.0f} s of processor time"
    print(f"{time.strftime('%H:%M:%S')}  {part.name:14} {state}", flush=True)
    if code != 0:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        print("\n".join(["", *lines[-TAIL:], "", f"all of it: {log.relative_to(ROOT)}; this part alone: validation/run --only '{part.name}'"]))
    elif log and (found := test_counts(log)):
        print(f"{'':10}{found}", flush=True)


def test_counts(log):
    """Test runners' own last words in one line, if there are any."""
    text = log.read_text(encoding="utf-8", errors="replace")
    passed = [int(count) for count in re.findall(r"^test result: ok. (\d+) passed", text, re.M)]
    passed += [int(count) for count in re.findall(r"^ *Summary .* tests run: (\d+) passed", text, re.M)]
    starts = [f"; {count}" for count in re.findall(r"^\d+ starts from seed \d+", text, re.M)]
    return f"{sum(passed)} passed, 0 failed{''.join(starts)}" if passed else ""


def stop():
    for leader in list(RUNNING):
        # It may have ended just now.
        with contextlib.suppress(ProcessLookupError):
            os.killpg(leader, signal.SIGTERM)


def run_all(parts, full, environment):
    """Seconds by part, or None at a failure."""
    waiting, running, seconds = list(parts), {}, {}
    names = {part.name for part in parts}
    with ThreadPoolExecutor(2) as pool:
        while waiting or running:
            for part in list(waiting):
                is_ready = all(name in seconds for name in part.after if name in names)
                is_alone = part.cargo and any(other.cargo for other in running.values())
                if len(running) < 2 and is_ready and not is_alone:
                    waiting.remove(part)
                    running[pool.submit(run, part, full, environment)] = part
            for done in wait(running, return_when=FIRST_COMPLETED).done:
                part = running.pop(done)
                code, took, log, before = done.result()
                report_line(part, code, took, log, before)
                if code != 0:
                    stop()
                    return None
                seconds[part.name] = took
    return seconds


def version():
    """The tested version, as git names it."""
    command = ["git", "describe", "--always", "--dirty"]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip() or "unknown"


def write_report(folder, made, seconds, began):
    """Every page says in its third line what was found; every file gets a last line that says when it was made."""
    minutes = (time.monotonic() - began) / 60
    lines = ["# Validation report", "", f"{made}: every part below passed; {minutes:.0f} minutes.", "", "| part | found |", "|---|---|"]
    for page in sorted(folder.glob("*.md")):
        if page.name != "README.md":
            text = page.read_text(encoding="utf-8")
            title, _, found = text.split("\n")[:3]
            lines.append(f"| [{title.removeprefix('# ')}]({page.name}) | {found} |")
            page.write_text(f"{text.rstrip()}\n\n{made}.\n", encoding="utf-8")
    for picture in folder.glob("*.svg"):
        picture.write_text(f"{picture.read_text(encoding='utf-8').rstrip()}\n<!-- {made.replace('--', '- -')} -->\n", encoding="utf-8")
    lines.append(f"| The library's own tests | {test_counts(STATE / 'tests.log')} |")
    lines += ["", "| part | seconds | of processor time |", "|---|---|---|", *(f"| {name} | {took:.0f} | {worked:.0f} |" for name, (took, worked) in seconds.items())]
    (folder / "README.md").write_text("\n".join(lines) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(prog="validation/run", description=__doc__.splitlines()[0])
    parser.add_argument("--full", action="store_true", help="all that there is, for releases")
    parser.add_argument("--fast", action="store_true", help="what concerns the change since main, in a minute")
    parser.add_argument("--only", action="append", metavar="PART", choices=[part.name for part in PARTS], help="this part; may be repeated")
    parser.add_argument("--list", action="store_true", help="the parts and what they run")
    parser.add_argument("--report", type=Path, help="folder of the report: validation/report with --full, else target/report")
    options = parser.parse_args()
    if options.list:
        for part in PARTS:
            print(f"{part.name:14} {part.small}" + (f"\n{'':14} --full: {part.full}" if part.full != part.small else ""))
        return 0
    report = (options.report or ROOT / ("validation/report" if options.full else "target/report")).resolve()
    report.mkdir(parents=True, exist_ok=True)
    STATE.mkdir(parents=True, exist_ok=True)
    environment = os.environ | {"IMPACT_PAIR": str(PROGRAM), "REPORT": str(report), "OCAMLRUNPARAM": OCAML} | ({} if options.full else LINTED)
    # Bytecode of packages is kept, beside no source: an import of SciPy or Matplotlib takes a second less.
    environment["PYTHONPYCACHEPREFIX"] = str(ROOT / "target/pycache")
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    # The report that goes is part of the version.
    began, made = time.monotonic(), f"Made by `validation/run{' --full' if options.full else ''}` on {time.strftime('%Y-%m-%d')} of version `{version()}`"
    if options.full and not options.only:
        for file in [*report.glob("*.md"), *report.glob("*.svg")]:
            file.unlink()
    signal.signal(signal.SIGINT, lambda *_: (stop(), os._exit(130)))
    parts = fast_parts() if options.fast else [part for part in PARTS if not options.only or part.name in options.only]
    seconds = run_all(parts, options.full, environment)
    if seconds is None:
        return 1
    if options.fast:
        print(f"passed in {time.monotonic() - began:.0f} s; validation/run passes all")
    elif not options.only:
        write_report(report, made, seconds, began)
        print(f"all passed in {time.monotonic() - began:.0f} s; {report / 'README.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
