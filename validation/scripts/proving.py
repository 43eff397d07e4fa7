"""Shared parts of the scripts that prove bounds from the source text: running Gappa and Coq, and reading Rust formulas.

`let` lines of Rust are nearly Python expressions, so Python's parser reads them. Here they become trees: tuples
`("+", a, b)`, `("fma", a, b, c)`, `("name", x)`, `("number", fraction)`, ... A `let` name stands for the tree it was given, the
same Python object each time, so that one rounded operation stays one operation. `Exact`, `Rounded` and `Shape` print
trees for Coq.
"""
import ast, math, re, subprocess
from fractions import Fraction


def run(command, folder, timeout=300):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=timeout)


def write(path, text):
    path.write_text(text)
    return path.name


def gappa(name, text, folder):
    """True if Gappa proves the goal, and its output."""
    path = write(folder / (re.sub(r"\W+", "_", name) + ".g"), text)
    result = run(["gappa", "-Eno-auto-dichotomy", path], folder)
    return result.returncode == 0, result.stdout + result.stderr


def coq(name, text, folder):
    """True if Coq accepts the file, and its output."""
    result = run(["coqc", "-q", write(folder / f"{name}.v", text)], folder)
    return result.returncode == 0, result.stdout + result.stderr[-300:]


def parse(source):
    return ast.parse(re.sub(r"\s+", " ", source.replace("&", "")).strip(), mode="eval").body


def filled(template, fill):
    """A template with what stands between @ signs filled in."""
    return re.sub(r"@(\w+)@", lambda found: fill[found[1]], template)


def uncommented(text):
    return re.sub(r"//.*", "", text).split("#[cfg(test)]")[0]


def braced(text, start):
    """The text between the brace that opens at or after `start` and the one that closes it, and where that is."""
    first = text.index("{", start)
    depth = 0
    for i in range(first, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return text[first + 1 : i].strip(), i + 1
    raise ValueError("unbalanced braces")


def split(text, at):
    """The parts between the separators `at` that stand outside of all brackets."""
    parts, depth = [""], 0
    for c in text:
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(c, 0)
        if c == at and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip()]


def body(text, head):
    """The argument names and the body of the one function that `head` begins: `fn name(` or `impl X: fn name(`."""
    start = 0
    for part in head.split(": "):
        start = text.index(part, start)
    assert ": " in head or text.count(head) == 1, head
    depth = 0
    for end in range(text.index("(", start), len(text)):
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        if depth == 0:
            break
    arguments = [a.rsplit(":", 1)[0].strip() for a in split(text[text.index("(", start) + 1 : end], ",") if ":" in a]
    return arguments, braced(text, end)[0]


def chosen(text, flag, value):
    """The text with `if FLAG { a } else { b }` replaced by what holds."""
    while found := re.search(rf"\bif {flag} ", text):
        yes, after = braced(text, found.end())
        no, end = braced(text, after)
        taken = yes if value else no
        text = text[: found.start()] + (taken if ";" in taken else f"({taken})") + text[end:]
    return text


class Reader:
    """Reads function bodies to trees. `known` gives trees for paths such as `self.flight.drift` or `pair.alpha.mag()`."""

    def __init__(self, known, functions=None):
        self.known, self.functions = known, functions or {}

    def function(self, definition, given=(), scope=None):
        """The tree of the last expression (for `Self { .. }` a dictionary), and the scope of all `let` names."""
        arguments, text = definition
        scope = dict(scope or {})
        # Arguments that are patterns bind names.
        for pattern, tree in zip(arguments, given):
            self.bind(pattern, tree, scope)
        value = None
        # Early returns change no value.
        for statement in split(re.sub(r"if [^{}]*\{\s*return [^{}]*;\s*\}", "", text), ";"):
            if found := re.fullmatch(r"let (.*?) = (.*)", statement, re.S):
                self.bind(found[1], self.read(found[2], scope), scope)
            else:
                value = self.read(statement, scope)
        return value, scope

    def bind(self, pattern, value, scope):
        pattern = pattern.strip().removeprefix("mut ")
        if re.fullmatch(r"\w+", pattern):
            scope[pattern] = value
        elif pattern.startswith("("):
            for part, item in zip(split(pattern[1:-1], ","), value):
                self.bind(part, item, scope)
        else:
            for part in split(braced(pattern, 0)[0], ","):
                if part != "..":
                    field, _, name = part.partition(": ")
                    scope[name or field] = self.path(f"{value[1]}.{field}" if value[0] == "path" else field)

    def read(self, text, scope):
        text = re.sub(r"\s+", " ", text).strip()
        if found := re.fullmatch(r"(?:Self|\w+) \{.*\}", text):
            fields = (part.partition(": ") for part in split(braced(text, 0)[0], ","))
            return {name: self.read(source or name, scope) for name, _, source in fields}
        if found := re.fullmatch(r"Some\((.*)\)", text):
            return self.read(found[1], scope)
        text = text.replace(".clone()", "").replace("&", "").replace("::", "__").removeprefix("*")
        return self.walk(parse(re.sub(r"(\d)f64\b", r"\1", text)), scope)

    def path(self, path):
        return self.known.get(path, ("path", path))

    def walk(self, node, scope):
        go = lambda inner: self.walk(inner, scope)
        match node:
            case ast.Name(id=name):
                return scope[name] if name in scope else self.path(name)
            case ast.Constant(value=value):
                return ("number", Fraction(float(value)))
            case ast.Tuple(elts=items):
                return tuple(map(go, items))
            case ast.Attribute(value=inner, attr=name):
                return self.path(f"{go(inner)[1]}.{name}")
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                value = go(inner)
                return ("number", -value[1]) if value[0] == "number" else ("neg", value)
            case ast.BinOp(left=left, op=op, right=right):
                sign, a, b = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}[type(op)], go(left), go(right)
                return constant(sign, a[1], b[1]) if a[0] == b[0] == "number" else (sign, a, b)
            case ast.Call(func=ast.Attribute(value=a, attr=("mul_add" | "mul_add_ref")), args=[b, c]):
                return ("fma", go(a), go(b), go(c))
            case ast.Call(func=ast.Attribute(value=a, attr="mul_sub_ref"), args=[b, c]):
                return ("fma", ("neg", go(a)), go(b), go(c))
            case ast.Call(func=ast.Attribute(value=a, attr=("plus" | "minus" | "times") as name), args=[b]):
                return ({"plus": "+", "minus": "-", "times": "*"}[name], go(a), go(b))
            case ast.Call(func=ast.Attribute(value=a, attr="min"), args=[b]):
                return ("min", go(a), go(b))
            case ast.Call(func=ast.Attribute(value=inner, attr=("abs" | "sqrt" | "next_up") as name), args=[]):
                return (name, go(inner))
            case ast.Call(func=ast.Attribute(value=inner, attr=name), args=given):
                value = go(inner)
                if value[0] in ("path", "name") and not given and f"{value[1]}.{name}()" in self.known:
                    return self.known[f"{value[1]}.{name}()"]
                if name in self.functions:
                    return self.function(self.functions[name], list(map(go, given)), {"self": value})[0]
            case ast.Call(func=ast.Name(id=name), args=given):
                if name in self.functions:
                    return self.function(self.functions[name], list(map(go, given)))[0]
                return (name, *map(go, given))
        raise ValueError(ast.unparse(node))


def constants(text):
    """The constants of a source text that are powers of two times a number."""
    found = re.findall(r"const (\w+): f64 = ([\d.]+) / \(1_u64 << (\d+)\) as f64;", text)
    return {name: float(x) / 2.0 ** int(power) for name, x, power in found}


def constant(sign, x, y):
    """An operation on constants, which must be exact in doubles."""
    value = {"+": x + y, "-": x - y, "*": x * y, "/": x / y if y else None}[sign]
    assert Fraction(float(value)) == value, (sign, x, y)
    return ("number", value)


class Exact:
    """Prints a tree as a real number."""

    def __init__(self, names=None):
        self.names = names or {}

    def show(self, tree):
        go = self.show
        match tree:
            case ("name", name):
                return name
            case ("number", value):
                return f"({value})" if value.denominator > 1 or value < 0 else f"{value}"
            case ("+" | "-" | "*" | "/" as sign, a, b):
                return f"({go(a)} {sign} {go(b)})"
            case ("fma", a, b, c):
                return f"({go(a)} * {go(b)} + {go(c)})"
            case ("neg", a):
                return f"(- {go(a)})"
            case ("abs", a):
                return f"(Rabs {go(a)})"
            case ("min", a, b):
                return f"(Rmin {go(a)} {go(b)})"
            case (("sqrt" | "up" | "binade") as function, a):
                return f"({function} {go(a)})"
        raise ValueError(tree)


class Rounded(Exact):
    """Prints a tree with `rnd` around every operation (products with a power of two as well: they may underflow)."""

    def show(self, tree):
        match tree:
            case ("+" | "-" | "*" | "/" | "fma" | "sqrt", *_):
                return f"(rnd {super().show(tree)})"
        return super().show(tree)


class Steps(Exact):
    """Lists the rounded operations of a tree, one line each: a name, the kind, and what it rounds.

    Sums of two doubles do not underflow; a product with a power of two is `scaled`: it does nothing else.
    """

    def __init__(self, names=None):
        super().__init__()
        self.lines, self.seen = [], {}
        self.called = {id(tree): name for name, tree in (names or {}).items()}

    def show(self, tree):
        if tree[0] not in ("+", "-", "*", "/", "fma", "sqrt"):
            return super().show(tree)
        if id(tree) not in self.seen:
            inner = super().show(tree)
            # A sum of two names, say x - y, is called x_y.
            plain = "_".join(self.show(t) for t in tree[1:])
            name = self.called.get(id(tree)) or (plain if re.fullmatch(r"\w+", plain) else f"step{len(self.lines) + 1}")
            self.seen[id(tree)] = (name, tree)
            scaled = tree[0] == "*" and tree[1][0] == "number" and math.frexp(tree[1][1])[0] in (0.5, -0.5)
            self.lines.append((name, "added" if tree[0] in "+-" else "scaled" if scaled else "fused", inner))
        return self.seen[id(tree)][0]


class Shape:
    """Prints a tree of what is not negative for the count of its roundings (operations.v); lists its leaves."""

    def __init__(self):
        self.leaves = set()

    def leaf(self, tree):
        self.leaves |= {word for word in re.findall(r"[A-Za-z_]\w*", Exact().show(tree))}
        return f"(Leaf {Exact().show(tree)})"

    def show(self, tree):
        go = self.show
        match tree:
            case ("+", a, b):
                return f"(Add {go(a)} {go(b)})"
            case ("*", a, b):
                return f"(Mul {go(a)} {go(b)})"
            case ("fma", a, b, c):
                return f"(Fma {go(a)} {go(b)} {go(c)})"
            case ("min", a, b):
                return f"(Min {go(a)} {go(b)})"
            case ("/", a, b) if b[0] in ("name", "abs", "number"):
                self.leaf(b)
                return f"(Div {go(a)} {Exact().show(b)})"
            case ("abs", ("-", a, b)):
                self.leaf(a), self.leaf(b)
                return f"(Diff {Exact().show(a)} {Exact().show(b)})"
            case ("abs" | "binade", ("name", _)) | ("name", _) | ("number", _):
                return self.leaf(tree)
        raise ValueError(tree)
