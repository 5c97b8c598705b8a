#!/usr/bin/env python3
"""Writes the letters of carom-draw: outlines of Inter (SIL Open Font License 1.1), one glyph a line.

    pip install fonttools brotli
    npm pack @fontsource/inter && tar xzf fontsource-inter-*.tgz
    tools/glyphs.py package crates/carom-draw/font

A line is the character's number (hexadecimal), its advance and its outline, in thousandths of an em, y downwards:
M and L with a point, Q with two points, Z. Figures all have the advance of 0, so that numbers do not dance in a film.
"""
import pathlib
import sys

from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

CHARACTERS = dict.fromkeys(
    [chr(c) for c in range(0x20, 0x7F)]
    + [chr(c) for c in range(0xA1, 0x180) if c != 0xAD]
    + list("αβγδεθκλμνπρστφχψωΓΔΘΛΣΦΨΩ")
    + list("‘’“”–—…−×÷·≈≠≤≥∞→←↑↓√∑∂⁻⁰¹²³⁴⁵⁶⁷⁸⁹₀₁₂₃")
)
SUBSETS = ["latin", "latin-ext", "greek", "greek-ext", "vietnamese", "cyrillic"]


def outline(font, name, shift):
    pen = DecomposingRecordingPen(font.getGlyphSet())
    font.getGlyphSet()[name].draw(pen)
    scale = 1000 / font["head"].unitsPerEm
    at = lambda p: f"{round(p[0] * scale + shift)} {round(-p[1] * scale)}"
    words = []
    for verb, points in pen.value:
        if verb == "moveTo":
            words.append("M" + at(points[0]))
        elif verb == "lineTo":
            words.append("L" + at(points[0]))
        elif verb == "qCurveTo":
            # Between two control points that follow each other lies a point of the curve, half-way.
            control, end = list(points[:-1]), points[-1]
            for k, c in enumerate(control):
                to = end
                if k + 1 < len(control):
                    n = control[k + 1]
                    to = ((c[0] + n[0]) / 2, (c[1] + n[1]) / 2)
                words.append(f"Q{at(c)} {at(to)}")
        elif verb == "closePath":
            words.append("Z")
        else:
            sys.exit(f"{name}: {verb}")
    return "".join(words)


def main(package, target):
    for weight, file in [(400, "regular"), (600, "semibold")]:
        fonts = []
        for subset in SUBSETS:
            path = pathlib.Path(package, "files", f"inter-{subset}-{weight}-normal.woff2")
            if path.exists():
                fonts.append(TTFont(path))
        lines, missing = [], []
        for char in CHARACTERS:
            font = next((f for f in fonts if ord(char) in f.getBestCmap()), None)
            if font is None:
                missing.append(char)
                continue
            name = font.getBestCmap()[ord(char)]
            scale = 1000 / font["head"].unitsPerEm
            advance, shift = font["hmtx"][name][0] * scale, 0
            if char.isdigit() and char.isascii():
                wide = font["hmtx"][font.getBestCmap()[ord("0")]][0] * scale
                advance, shift = wide, (wide - advance) / 2
            lines.append(f"{ord(char):x} {round(advance)} {outline(font, name, shift)}".rstrip())
        pathlib.Path(target, f"{file}.glyphs").write_text("\n".join(lines) + "\n")
        print(file, len(lines), "glyphs; not in the font:", "".join(missing))


if __name__ == "__main__":
    main(*sys.argv[1:])
