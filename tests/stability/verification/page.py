"""Writes docs/verification.md and its plots."""
from verification.plot import draw

HEAD = """# Stiff and extreme cases

`tests/stability/verify` makes this page: it runs {count} scenes with the installed program, each on one thread, and
compares what comes out with what is known from outside of the program. {good} of {count} came out as expected{bad}.

- *must come out*: a number with the largest difference that is allowed, and where the number is known from; or an
  error, with its exit code and words of its message.
- *drift*: the error of the energy balance over the gross energy (`energy.relative_error` of `summary.json`).
- *step*: the step over the critical step that the program states. States of rest have no step.
- *s*: seconds of the whole run, the start of the program included, on a machine that was busy with other work.

| family | cases | as expected |
|---|---|---|
{families}
"""
TABLE = """| case | what | must come out | came out | drift | step | s | |
|---|---|---|---|---|---|---|---|
"""
LENGTH = 200  # of a message, on the page
OTHER = ("the body:", "wrong input,")


def came_out(outcome):
    if outcome.code == 0:
        return "done" if outcome.value is None else f"{outcome.value:.7g}"
    return f"exit code {outcome.code}: {reason(outcome.message)}"


def reason(message):
    """The sentence of a message that says what is wrong, without what a run says about itself before."""
    lines = [line.strip().removeprefix("hyperlattice: ") for line in message.splitlines()]
    failed = [line for line in lines if line.startswith("failed:")]
    said = " ".join(failed or [line for line in lines if not line.startswith(OTHER)])
    return said if len(said) <= LENGTH else said[:LENGTH].rsplit(" ", 1)[0] + " ..."


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def row(outcome):
    case = outcome.case
    drift = "" if outcome.drift is None else f"{outcome.drift:.0e}"
    step = "" if outcome.step is None else f"{outcome.step:.3g}"
    verdict = "as expected" if outcome.as_expected else "**not expected**"
    cells = (f"`{case.name}`", cell(case.what), cell(str(case.expected)), cell(came_out(outcome)), drift, step,
             f"{outcome.seconds:.2f}", verdict)
    return f"| {' | '.join(cells)} |\n"


def section(family, outcomes):
    return f"\n## {family.title}\n{family.why}\n\n{TABLE}{''.join(map(row, outcomes))}\n" \
           f"![{family.title}](verification/{family.name}.svg)\n\n{family.reading}\n"


def write(docs, families, outcomes):
    of = {family.name: [outcomes[case.name] for case in family.cases] for family in families}
    good = sum(outcome.as_expected for outcome in outcomes.values())
    count = len(outcomes)
    lines = [f"| [{family.title}](#{anchor(family.title)}) | {len(of[family.name])} | "
             f"{sum(outcome.as_expected for outcome in of[family.name])} |" for family in families]
    bad = "" if good == count else f", {count - good} did not"
    text = HEAD.format(count=count, good=good, bad=bad, families="\n".join(lines))
    text += "".join(section(family, of[family.name]) for family in families)
    (docs / "verification.md").write_text(text, encoding="utf-8")
    for family in families:
        draw(docs / "verification" / f"{family.name}.svg", family.plot, of[family.name])


def anchor(title):
    return "".join(c for c in title.lower() if c.isalnum() or c in " -").replace(" ", "-")
