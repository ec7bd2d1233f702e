"""The catalogue of effects, from the effects' own files."""

from __future__ import annotations

import inspect

from tire_pipeline.mismatch.effects import Effect, catalogue

SHOWN = ("covers", "lacks", "not_covered", "does_not_cover")


def page() -> str:
    """Return the page."""
    effects = sorted(catalogue().values(), key=lambda effect: (effect.kind != "physics", effect.name))
    lines = [
        "# Catalogue of effects",
        "",
        "`explain_mismatch` looks for these effects and for no others. What none of them explains is an",
        "[unexplained residual](glossary.md#unexplained-residual). The page is made from the effects' own files in",
        "`src/tire_pipeline/mismatch/effects`. How they are searched for and tested is in",
        "[Mismatch](../explanation/mismatch.md).",
        "",
    ]
    for kind, title in (("physics", "Physics: what the tire does"), ("artefact", "Artefacts: faults of the recording")):
        lines += [f"## {title}", "", "| effect | in words | channels it needs |", "|---|---|---|"]
        chosen = [effect for effect in effects if effect.kind == kind]
        lines += [f"| [`{e.name}`](#{e.name}) | {e.title} | {_channels(e)} |" for e in chosen]
        lines.append("")
        for effect in chosen:
            lines += _one(effect)
    return "\n".join(lines) + "\n"


def _channels(effect: Effect) -> str:
    named = [f"`{name}` (has to vary)" for name in effect.channels] + [f"`{name}`" for name in effect.used]
    return ", ".join(named + (["`time`"] if effect.needs_time else [])) or "none beside the forces"


def _one(effect: Effect) -> list[str]:
    lines = [f"### {effect.name} {{ #{effect.name} }}", ""]
    said = (inspect.getdoc(type(effect)) or "").split("\n\n")
    lines += [f"**{effect.title[:1].upper()}{effect.title[1:]}.** {' '.join(said[0].split())}", ""]
    for text in said[1:]:
        lines += [" ".join(text.split()), ""]
    if effect.equation:
        lines += ["```text", *effect.equation.split("; "), "```", ""]
    if effect.source:
        lines += [f"Source: {effect.source}.", ""]
    lines += [f"Needs: {_channels(effect)}.", ""]
    for name in SHOWN:
        text = getattr(effect, name, "")
        if text:
            lines += [f"{name.replace('_', ' ').capitalize()}: {text if isinstance(text, str) else '; '.join(text)}.", ""]
    if effect.parameters:
        lines += ["| parameter | unit | bounds | no effect at |", "|---|---|---|---|"]
        lines += [f"| `{p.name}` | {p.unit} | {p.low:g} to {p.high:g} | {p.zero:g} |" for p in effect.parameters]
        lines.append("")
    if effect.looks_like:
        lines += ["Looks like:", ""]
        known = catalogue()
        for name, text in effect.looks_like.items():
            lines.append(f"- [`{name}`](#{name}): {text}." if name in known else f"- `{name}`: {text}.")
        lines.append("")
    if effect.experiment:
        lines += [f"To be sure of it: {effect.experiment}.", ""]
    return lines
