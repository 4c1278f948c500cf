"""What rumoca 0.10.2 says, in words for whoever wrote the model, with the cure."""

import re

_HERE = "in this model (the line is its first)"

# A message that holds the pattern becomes the text, with the pattern's groups put in.
_SAID = {
    r"der\(\.\.\.\) must name a coordinate": (
        "der() of an input, or of another variable that is no state, is not supported; write its equation instead"
    ),
    r"(.*violates constrainedby.*)": r"\1; name a class that both extend behind constrainedby",
    r"expression shape mismatch": (
        f"types or sizes do not agree {_HERE}: on both sides of an equation, or in an expression or a modification"
    ),
    r"(delay\(\).* must have type `Real`, found `Integer`)": r"\1; write 1.0 instead of 1",
    r"expected Real, found Integer": (
        f"an Integer stands where a Real is meant {_HERE}; write 1.0 instead of 1, as in cross({{1.0, 0.0, 0.0}}, v)"
    ),
    r"expected a numeric expression, found Enumeration": (
        f"a number is expected where an enumeration stands {_HERE}; Integer(e) is not supported, compare e with its "
        "literals: if e == E.a then 1 else 2"
    ),
    r"(edge|change)\(\.\.\.\) must (?:name a discrete coordinate|have exactly one resolved variable)": (
        rf"\1() of an input or of an expression is not supported {_HERE}; give it a variable of its own, as in "
        r"Boolean inside = u, and use \1(inside)"
    ),
    r"pre\(`([^`]+)`\) names an external input": (
        rf"pre() of the input \1 is not supported {_HERE}; give it a variable of its own, as in Boolean inside = \1, "
        "and use pre(inside)"
    ),
    r"`(([^`]+)\[[^`]*\])` is not a discrete coordinate": (
        rf"a when-clause cannot set the single element \1 {_HERE}; set all of \2 in one when-clause, as in "
        r"\2 = {if ... then ... else pre(\2[1]), ...}"
    ),
    r"reinit\(\).*: ((\S+)\[\S*\]) is not a state": (
        rf"reinit of the single element \1 is not supported {_HERE}; give all of \2, as in reinit(\2, {{...}})"
    ),
    r"unsupported Flat semantic owner `function loop domain`: `([^`]+)`": (
        rf"a loop in function \1 goes over something else than a range {_HERE}; write one, as in for i in 1:2:5 loop"
    ),
    r"invalid unit for `([^`]+)`: (?:malformed unit expression: )?(.+?)(?: \(MLS.*)?$": (
        r"the unit of \1 cannot be read: \2; write it with whole powers, as m3/(s.Pa) or kg/(m.s2), and take a root of "
        r"a ratio: Q_n*sqrt(dp/dp_n) with Q_n in m3/s and dp_n in Pa"
    ),
    r"unsupported model algorithm in canonical DAE": (
        f"an algorithm section can give only one continuous variable, a scalar, by assignments and if {_HERE}; write "
        "equations, an algorithm section for each variable, or a function"
    ),
}


def in_plain_words(message: str) -> str:
    count = re.search(r"unbalanced model: (\d+) equations?, (\d+) unknowns?", message)
    if count:
        equations, unknowns = int(count.group(1)), int(count.group(2))
        cure = "add" if equations < unknowns else "remove"
        return (
            f"unbalanced model: {equations} equations for {unknowns} unknowns; "
            f"{cure} {abs(equations - unknowns)}, or make a variable an input or a parameter"
        )
    for pattern, plain in _SAID.items():
        found = re.search(pattern, message)
        if found:
            return found.expand(plain)
    return message
