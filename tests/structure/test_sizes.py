"""Files stay under 400 lines, functions under 60, and the median function is short."""
import re
import statistics

from repository import ROOT, code_files

OPENING = re.compile(r"^(?!\s*(namespace|struct|class|enum|union|extern|if|for|while|switch|do|else|NAMESPACE_BEGIN|#|//)\b)"
                     r"[\w:<>,&*~\[\]\s()\"=.+-]*\([^;]*\)\s*(const)?\s*(noexcept)?\s*(override)?\s*(->\s*[\w:<>]+\s*)?\{")


def function_lengths(text):
    """Lengths of function bodies, by braces, of a file in our format: bodies start at a line that looks like a definition."""
    lines, lengths, index = text.splitlines(), [], 0
    while index < len(lines):
        if OPENING.match(lines[index]) and "{" in lines[index]:
            depth, start = 0, index
            while index < len(lines):
                bare = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'|//.*', "", lines[index])
                depth += bare.count("{") - bare.count("}")
                if depth <= 0:
                    break
                index += 1
            body = [line for line in lines[start + 1:index] if line.strip()]
            lengths.append((len(body) if index > start else 1, start + 1))
        index += 1
    return lengths


def measured():
    for path in code_files():
        if path.endswith((".cpp", ".h", ".glslh")) and not re.search(r"_(test|fuzz)\.cpp$", path):
            for length, line in function_lengths((ROOT / path).read_text()):
                yield length, f"{path}:{line}"


def test_Files_AllOfThem_StayUnder400Lines():
    long = [(p, n) for p in code_files() if (n := len((ROOT / p).read_text().splitlines())) > 400]
    assert long == []


def test_Functions_AllOfThem_StayUnder60Lines():
    assert [(n, where) for n, where in measured() if n > 60] == []


def test_Functions_TheMedian_IsAtMost10Lines():
    lengths = [n for n, _ in measured()]
    assert len(lengths) > 100 and statistics.median(lengths) <= 10


def test_Measure_AKnownFunction_IsCounted():
    text = "int twice(int x) {\n  int y = x;\n\n  return 2 * y;\n}\n"
    assert function_lengths(text) == [(2, 1)]
