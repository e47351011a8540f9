//! The words of the language that are no functions, each with its form and what it does, for `yont doc` and `:help`.

/// A word, its form, what it does.
pub type Word = (&'static str, &'static str, &'static str);

/// Keywords, geometric types and settings.
pub static WORDS: &[Word] = &[
    ("IF", "IF c THEN a ELSE b", "A choice, of values or of statements; without ELSE undefined elsewhere."),
    ("THEN", "IF c THEN a ELSE b", "What holds where the condition of an IF is true."),
    ("ELSE", "IF c THEN a ELSE b", "What holds where the condition of an IF is false."),
    ("WHILE", "WHILE (c) DO s;", "Repeats a statement, or BEGIN ... END, while the condition is true."),
    ("FOR", "FOR i = a TO b STEP k DO s;", "Repeats a statement, or BEGIN ... END, for each i from a to b."),
    ("DO", "WHILE (c) DO s;", "Stands before what a loop repeats."),
    ("TO", "FOR i = a TO b DO s;", "Stands before the last value of an index."),
    ("STEP", "FOR i = a TO b STEP k DO s;", "Stands before the step of an index, or of a parameter's range."),
    ("BEGIN", "BEGIN s; s; END", "Several statements as one; also the body of a function, whose names are local."),
    ("END", "BEGIN s; s; END", "Closes BEGIN."),
    ("AND", "a AND b", "1 where both are true (not 0), else 0."),
    ("OR", "a OR b", "1 where one is true (not 0), else 0."),
    ("NOT", "NOT a", "1 where a is 0, else 0."),
    ("AT", "e AT (x1 = u, x3 = v)", "The object e at the mapped point: a shift by 5 is e AT (x1 = x1 - 5)."),
    ("WHERE", "e WHERE q = a, s = b", "Names for parts of an expression; later ones see earlier ones."),
    ("IN", "r = 4 IN [1, 8] STEP 0.5;", "The range of a parameter, for a slider."),
    ("INCLUDE", "INCLUDE \"file.geo\";", "The definitions of another file, looked for beside this one."),
    ("PRINT", "PRINT e, \"text\";", "Shows values as they are at this place."),
    ("PI", "PI", "3.14159..., half a turn in radians."),
    ("INFINITY", "INFINITY", "Beyond all numbers: the p of a largest or smallest value in PNORM and STAR."),
    ("R_ALPHA", "r_alpha = 1;", "The system of R-functions from here on: 1 is min and max, 0 (the default) smooth."),
    ("R_M", "r_m = 1;", "R-functions with that many continuous derivatives from here on; 0 is off."),
    ("X", "x1 : X;", "A geometric type: the first axis of space. Y and Z are the others."),
    ("Y", "x2 : Y;", "A geometric type: the second axis of space."),
    ("Z", "x3 : Z;", "A geometric type: the third axis of space, upwards."),
    ("T", "x4 : T;", "A geometric type: time, in frames from x4min to x4max by x4_delta."),
    ("V", "x5 : V;", "A geometric type: columns of a sheet of pictures. W makes its rows."),
    ("W", "x5 : W;", "A geometric type: rows of a sheet of pictures."),
    ("C", "x6 : C;", "A geometric type: colours over the spectrum, with a legend."),
    ("G", "x8 : G = [0, 1, 2];", "A geometric type: a group of sections, or of levels of the function itself."),
    (
        "CONSTANT",
        "x7 : CONSTANT = 0.5;",
        "A geometric type: a single section, or another level of the function itself.",
    ),
    (
        "CENTER",
        "gob_a : CENTER = [0, 0, 0];",
        "A point from which the whole boundary is seen, where the user knows one.",
    ),
];

/// What there is to say of a word, in any case; nothing if it is none.
#[must_use]
pub fn explain(word: &str) -> Option<String> {
    if crate::model::environment::is_setting(word) {
        let (c, end) = word.split_at(word.find(['m', '_'])?);
        return Some(match end {
            "_delta" => {
                format!("{word} = 0.1;\n    The step of {c} where it is shown in steps: frames, columns, sections.")
            }
            _ => format!(
                "{c}min = -10; {c}max = 10;\n    The modelling space along {c}: what lies outside is not shown."
            ),
        });
    }
    let (_, form, what) = WORDS.iter().find(|(known, ..)| known.eq_ignore_ascii_case(word))?;
    Some(format!("{form}\n    {what}"))
}
