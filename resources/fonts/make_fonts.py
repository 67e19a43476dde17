#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the fonts that the program carries; run by hand when one of them changes, never by the build.

"PhaseSketch UI" is Inter 4 (Debian: fonts-inter) cut down to Latin, Greek, Cyrillic, punctuation and mathematics. Its
digits and the signs that stand among them are the tabular forms, because Qt before 6.7 cannot switch `tnum` on: a
running number must not jitter. "PhaseSketch Symbols" is Noto Serif Italic (Debian: fonts-noto-core) cut down to the
letters of formula symbols. Needs python3-fonttools.

    make_fonts.py [--inter DIR] [--noto DIR] [--out DIR]
"""
import argparse
import pathlib

from fontTools import subset
from fontTools.ttLib import TTFont

INTER = "/usr/share/fonts/opentype/inter"
NOTO = "/usr/share/fonts/truetype/noto"
TABULAR = "0123456789.,:+-\u2212="
WEIGHTS = ("Regular", "Medium", "SemiBold")

UI_RANGES = [(0x20, 0x7E), (0xA0, 0x17F), (0x192, 0x192), (0x218, 0x21B), (0x2C6, 0x2DD), (0x384, 0x3CE),
             (0x400, 0x45F), (0x490, 0x491), (0x2000, 0x200B), (0x2010, 0x2027), (0x202F, 0x203A), (0x2044, 0x2044),
             (0x205F, 0x205F), (0x2070, 0x208E), (0x20AC, 0x20AC), (0x2100, 0x2122), (0x2126, 0x2126),
             (0x2150, 0x215F), (0x2190, 0x2199), (0x2200, 0x22A5), (0x22C5, 0x22C5), (0x2318, 0x2318),
             (0x25A0, 0x25CF), (0x2713, 0x2717)]
SYMBOL_RANGES = [(0x20, 0x7E), (0xB7, 0xB7), (0xD7, 0xD7), (0x391, 0x3A9), (0x3B1, 0x3C9), (0x3D1, 0x3D6),
                 (0x2032, 0x2033), (0x2212, 0x2212)]


def tabular_forms(font):
    """Glyph name to its tabular form, from the font's own `tnum` feature."""
    table = font["GSUB"].table
    lookups = {i for record in table.FeatureList.FeatureRecord if record.FeatureTag == "tnum"
               for i in record.Feature.LookupListIndex}
    forms = {}
    for index in lookups:
        for subtable in table.LookupList.Lookup[index].SubTable:
            subtable = getattr(subtable, "ExtSubTable", subtable)
            forms.update(getattr(subtable, "mapping", {}))
    return forms


def use_tabular_forms(font):
    forms = tabular_forms(font)
    for table in font["cmap"].tables:
        if table.isUnicode():
            for code, glyph in list(table.cmap.items()):
                if chr(code) in TABULAR and glyph in forms:
                    table.cmap[code] = forms[glyph]
    best = font.getBestCmap()
    digits = [best[ord(digit)] for digit in "0123456789"]
    widths = [font["hmtx"][glyph][0] for glyph in digits]
    if max(widths) - min(widths) > font["head"].unitsPerEm / 500:
        raise SystemExit(f"digits are not tabular: widths {sorted(set(widths))}")
    for glyph in digits:  # interpolated weights are off by a unit or two
        font["hmtx"][glyph] = (max(widths), font["hmtx"][glyph][1])


def rename(font, family, weight):
    names = font["name"]
    names.names = [n for n in names.names if n.nameID in (0, 5, 7, 8, 9, 11, 13, 14)]
    style = {"SemiBold": "Semi Bold"}.get(weight, weight)
    postscript = family.replace(" ", "") + "-" + weight
    values = {3: postscript, 4: f"{family} {style}", 6: postscript, 16: family, 17: style,
              1: family if weight in ("Regular", "Italic") else f"{family} {style}",
              2: weight if weight in ("Regular", "Italic") else "Regular"}
    for identity, text in values.items():
        names.setName(text, identity, 3, 1, 0x409)
    if "CFF " in font:
        cff = font["CFF "].cff
        cff.fontNames = [postscript]
        top = cff.topDictIndex[0]
        top.FullName, top.FamilyName = f"{family} {style}", family


def cut(font, ranges, features):
    options = subset.Options()
    options.layout_features = features
    options.name_IDs = ["*"]
    options.notdef_outline = True
    options.hinting = False
    options.desubroutinize = False
    cutter = subset.Subsetter(options)
    cutter.populate(unicodes=[code for first, last in ranges for code in range(first, last + 1)])
    cutter.subset(font)


def save(font, path):
    font["head"].created = font["head"].modified = 0  # the same input gives the same bytes
    font.recalcTimestamp = False
    font.save(path)
    print(f"{path}: {path.stat().st_size} bytes, {len(font.getGlyphOrder())} glyphs")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--inter", type=pathlib.Path, default=pathlib.Path(INTER))
    parser.add_argument("--noto", type=pathlib.Path, default=pathlib.Path(NOTO))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent)
    arguments = parser.parse_args()
    for weight in WEIGHTS:
        font = TTFont(arguments.inter / f"Inter-{weight}.otf", recalcTimestamp=False)
        use_tabular_forms(font)
        cut(font, UI_RANGES, ["kern", "mark", "mkmk", "ccmp", "locl"])
        rename(font, "PhaseSketch UI", weight)
        save(font, arguments.out / f"PhaseSketchUI-{weight}.otf")
    font = TTFont(arguments.noto / "NotoSerif-Italic.ttf", recalcTimestamp=False)
    cut(font, SYMBOL_RANGES, ["kern"])
    rename(font, "PhaseSketch Symbols", "Italic")
    save(font, arguments.out / "PhaseSketchSymbols-Italic.ttf")


if __name__ == "__main__":
    main()
