"""Reading back what Blend/Export.py writes: the blocks of a scene text and their values."""

def tokens_of(line):
    out, i = [], 0
    while i < len(line):
        if line[i].isspace():
            i += 1
        elif line[i] == "#":
            break
        elif line[i] == '"':
            text, i = "", i + 1
            while line[i] != '"':
                i += line[i] == "\\"
                text += line[i]
                i += 1
            out.append(text)
            i += 1
        else:
            j = i
            while j < len(line) and not line[j].isspace():
                j += 1
            out.append(line[i:j])
            i = j
    return out


def plain(token):
    try:
        return float(token)
    except ValueError:
        return {"true": True, "false": False}.get(token, token)


class Block:
    def __init__(self, kind, name):
        self.kind, self.name, self.lines, self.arrays = kind, name, [], {}

    def __getitem__(self, keyword):
        values = self.get(keyword)
        if values is None:
            raise AssertionError("%s '%s' has no '%s'" % (self.kind, self.name, keyword))
        return values

    def get(self, keyword, default=None):
        for key, values in self.lines:
            if key == keyword:
                return values[0] if len(values) == 1 else values
        return default

    def lobes(self):
        """A dictionary for each: kind, covers, numbers by keyword, what multiplies them by (keyword, 'x')."""
        out = []
        for values in (v for key, v in self.lines if key == "lobe"):
            lobe, keyword, i = {"kind": values[0]}, None, 1
            while i < len(values):
                token, i = values[i], i + 1
                if token in ("times", "without"):
                    factor, i = [token, values[i]], i + 1
                    if i < len(values) and isinstance(values[i], float):
                        factor, i = factor + [values[i]], i + 1
                    lobe.setdefault((keyword, "x"), []).append(factor)
                elif token == "covers":
                    lobe[token] = True
                elif isinstance(token, float):
                    lobe[keyword].append(token)
                else:
                    keyword, lobe[token] = token, []
            out.append(lobe)
        return out

    def lobe(self, kind):
        found = [l for l in self.lobes() if l["kind"] == kind]
        assert len(found) == 1, "%d lobes %s in %s" % (len(found), kind, self.lines)
        return found[0]

    def keys(self):
        """The 3x4 matrices of its positions."""
        rows, out = None, []
        for key, v in self.lines:
            step = None
            if key == "translate":
                step = [[1, 0, 0, v[0]], [0, 1, 0, v[1]], [0, 0, 1, v[2]]]
            elif key == "scale" and self.kind != "texture":
                step = [[v[0], 0, 0, 0], [0, v[1], 0, 0], [0, 0, v[2], 0]]
            elif key == "transform":
                step = [v[0:4], v[4:8], v[8:12]]
            elif key == "key":
                out.append(rows)
                rows = None
            if step:
                rows = step if rows is None else multiply(rows, step)
        out.append(rows)
        identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
        return [r or identity for r in out]


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) + (a[i][3] if j == 3 else 0) for j in range(4)] for i in range(3)]


class SceneText:
    """The blocks of a scene text, by kind and name."""

    def __init__(self, text):
        lines = text.split("\n")
        assert lines[0] == "raytracer 1", lines[0]
        self.text, self.blocks = text, []
        block, counted = None, None
        for line in lines[1:]:
            tokens = tokens_of(line)
            if not tokens:
                continue
            if tokens[-1] == "{":
                block = Block(tokens[0], tokens[1] if len(tokens) > 2 else "")
                self.blocks.append(block)
            elif tokens == ["}"]:
                block = None
            elif block.kind == "mesh":
                if len(tokens) == 2 and not tokens[0].lstrip("-")[:1].isdigit():
                    counted = block.arrays[tokens[0]] = []
                    block.lines.append((tokens[0], [float(tokens[1])]))
                else:
                    counted.append([float(t) for t in tokens])
            else:
                block.lines.append((tokens[0], [plain(t) for t in tokens[1:]]))

    def all(self, *kinds):
        return [b for b in self.blocks if b.kind in kinds]

    def one(self, kind, name=None):
        found = [b for b in self.all(kind) if name is None or b.name == name]
        assert len(found) == 1, "%d blocks '%s %s' in\n%s" % (len(found), kind, name or "", self.text[:3000])
        return found[0]


def near(got, wanted, tolerance=1e-5):
    got = [got] if isinstance(got, (int, float)) else [x for r in got for x in (r if hasattr(r, "__len__") else [r])]
    wanted = [wanted] if isinstance(wanted, (int, float)) else [
        x for r in wanted for x in (r if hasattr(r, "__len__") else [r])]
    size = max([abs(x) for x in wanted] + [1e-9])
    assert len(got) == len(wanted) and all(abs(a - b) <= tolerance * size for a, b in zip(got, wanted)), \
        "got %s, wanted %s" % (got, wanted)


def equal(got, wanted):
    assert got == wanted, "got %r, wanted %r" % (got, wanted)
