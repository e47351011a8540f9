//! Random programs, always legal, in random spelling: spaces, comments, case, optional parts.

/// A small generator of random numbers, so that a failure can be repeated from its seed.
pub struct Random(pub u64);

const KINDS: [&str; 12] = [
    "X",
    "y",
    "Z",
    "T",
    "v",
    "W",
    "C",
    "CONSTANT = 0.5",
    "g = [0, 1]",
    "Center",
    "color = [x1, 0, 1]",
    "COLOUR = x3 IN [-1, a]",
];

impl Random {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 33) as usize % n
    }

    pub fn one<'a>(&mut self, of: &[&'a str]) -> &'a str {
        of[self.below(of.len())]
    }

    fn chance(&mut self, of: usize) -> bool {
        self.below(of) == 0
    }
}

/// A program of a few statements.
pub fn program(random: &mut Random) -> String {
    let mut g = Generator { random, out: String::new() };
    let count = g.random.below(4) + 1;
    let depth = g.random.below(7) / 2 % 3;
    for _ in 0..count {
        if g.random.chance(3) {
            let comment =
                g.random.one(&["{ a comment; with (brackets }\n", "// a line's \"end\"\n", "{ two\n  lines }\n\n"]);
            g.out.push_str(comment);
        }
        g.statement(depth, true);
        g.out.push(';');
        let end = g.random.one(&["\n", " ", "\r\n", "\n\n\n", " // behind\n", " { behind }\n"]);
        g.out.push_str(end);
    }
    g.out
}

struct Generator<'r> {
    random: &'r mut Random,
    out: String,
}

impl Generator<'_> {
    fn put(&mut self, text: &str) {
        self.out.push_str(text);
        if self.random.chance(40) {
            self.out.push_str("{ in the middle }");
        }
    }

    /// A symbol, with space around it or not.
    fn symbol(&mut self, text: &str) {
        let space = self.random.one(&["", " ", " ", "\n  "]);
        self.put(&format!("{space}{text}{space}"));
    }

    fn word(&mut self, text: &str) {
        let spelt = if self.random.chance(3) { text.to_lowercase() } else { text.to_owned() };
        self.put(&format!(" {spelt} "));
    }

    fn name(&mut self) {
        let name = self.random.one(&[
            "a",
            "b",
            "gob_a",
            "pob_ball",
            "r1",
            "x",
            "x1min",
            "atan",
            "top",
            "sum",
            "t",
            "height",
            "épaisseur",
            "begins",
        ]);
        self.put(name);
    }

    fn number(&mut self) {
        let number = self.random.one(&["1", "1.", ".5", "1.5e-3", "0", "12.25", "3E4", "8"]);
        self.put(number);
    }

    fn list(&mut self, depth: usize, least: usize, one: fn(&mut Self, usize)) {
        let count = least + self.random.below(3);
        for n in 0..count {
            if n > 0 {
                self.symbol(",");
            }
            one(self, depth);
        }
        if count > 0 && self.random.chance(6) {
            self.symbol(",");
        }
    }

    fn statement(&mut self, depth: usize, top: bool) {
        let kinds = if depth == 0 { 6 } else { 10 };
        match self.random.below(kinds) {
            0 | 1 => {
                self.name();
                self.symbol("=");
                self.value(depth);
                if self.random.chance(6) {
                    self.word("IN");
                    self.symbol("[");
                    self.expr(1);
                    self.symbol(",");
                    self.expr(1);
                    self.symbol("]");
                    if self.random.chance(2) {
                        self.word("STEP");
                        self.expr(0);
                    }
                }
            }
            2 => {
                self.out.push_str("f_1(");
                let parameters = ["", "u", "(gob/pob) g1, (real) k", "u, v,", "(array) q, (text) s, (function) p"];
                let parameters = self.random.one(&parameters);
                self.put(parameters);
                self.symbol(")");
                self.symbol("=");
                if depth > 0 && self.random.chance(2) { self.block(depth) } else { self.value(depth) }
            }
            3 => {
                self.out.push_str("arr");
                self.index(depth);
                self.symbol("=");
                self.value(depth);
            }
            4 => {
                let subject = self.random.one(&["x4", "X1", "gob_a"]);
                self.put(subject);
                self.symbol(":");
                let kind = self.random.one(&KINDS);
                self.put(kind);
            }
            5 => {
                let printed = self.random.one(&[
                    "PRINT a, \"text\"",
                    "print",
                    "INCLUDE \"a b.geo\"",
                    "a == b",
                    "(a = b)",
                    "f_1(2)",
                    "-a",
                ]);
                self.put(printed);
            }
            6 => {
                self.word("WHILE");
                self.expr(depth - 1);
                self.word("DO");
                self.branch(depth - 1);
            }
            7 => {
                self.word("FOR");
                self.name();
                self.symbol("=");
                self.expr(depth - 1);
                self.word("TO");
                self.expr(depth - 1);
                if self.random.chance(2) {
                    self.word("STEP");
                    self.expr(0);
                }
                self.word("DO");
                self.branch(depth - 1);
            }
            _ => {
                self.word("IF");
                self.expr(depth - 1);
                self.word("THEN");
                if self.random.chance(2) {
                    self.branch(depth - 1);
                } else {
                    // In a block, so that no IF inside takes the ELSE.
                    self.block(depth - 1);
                    let end = self.random.one(&["", ";", ";\n"]);
                    self.out.push_str(end);
                    self.word("ELSE");
                    self.branch(depth - 1);
                }
            }
        }
        if top && self.random.chance(12) {
            self.out.push(';');
        }
    }

    fn branch(&mut self, depth: usize) {
        if self.random.chance(2) { self.block(depth) } else { self.statement(depth, false) }
    }

    fn block(&mut self, depth: usize) {
        self.word("BEGIN");
        let count = self.random.below(4);
        for n in 0..count {
            self.statement(depth.saturating_sub(1), false);
            if n + 1 < count || self.random.chance(2) {
                let end = self.random.one(&["; ", ";\n", "; { behind }\n", ";\n\n  // own line\n"]);
                self.out.push_str(end);
            }
        }
        self.word("END");
    }

    fn value(&mut self, depth: usize) {
        self.expr(depth);
        if self.random.chance(8) {
            self.word("WHERE");
            self.out.push_str("q = ");
            self.expr(depth.saturating_sub(1));
            if self.random.chance(2) {
                self.out.push_str(", s = ");
                self.expr(0);
            }
        }
    }

    fn expr(&mut self, depth: usize) {
        if depth > 0 && self.random.chance(10) {
            self.word("IF");
            self.expr(depth - 1);
            self.word("THEN");
            self.expr(depth - 1);
            if self.random.chance(2) {
                self.word("ELSE");
                self.expr(depth - 1);
            }
            return;
        }
        if self.random.chance(12) {
            self.word("NOT");
        }
        self.term(depth);
        // One comparison at most, so that no set operation lands in a chain of two.
        let mut compared = false;
        for _ in 0..self.random.below(4) {
            if !compared && self.random.chance(6) {
                let op = self.random.one(&["<", "<=", ">", ">=", "=", "==", "<>", "!=", "/="]);
                self.symbol(op);
                compared = true;
            } else if self.random.chance(8) {
                let op = self.random.one(&["AND", "OR"]);
                self.word(op);
                compared = true;
                if self.random.chance(3) {
                    self.word("NOT");
                }
            } else {
                let op = self.random.one(&["+", "-", "*", "/", "**", "^", "|", "\\", "&", "@"]);
                self.symbol(op);
            }
            self.term(depth);
        }
    }

    fn term(&mut self, depth: usize) {
        while self.random.chance(6) {
            let sign = self.random.one(&["-", "+", "~", "- "]);
            self.put(sign);
        }
        self.primary(depth);
        if depth > 0 && self.random.chance(8) {
            self.index(depth - 1);
        }
        if depth > 0 && self.random.chance(10) {
            self.word("AT");
            let mapped = self.random.chance(2);
            self.out.push('(');
            if mapped {
                self.out.push_str("x1 = ");
                self.expr(depth - 1);
                self.out.push_str(", X3= 2");
            } else {
                self.list(depth - 1, 1, Self::plain);
            }
            self.symbol(")");
        }
    }

    /// An argument that cannot be taken for `name = value`.
    fn plain(&mut self, depth: usize) {
        self.out.push('(');
        self.expr(depth);
        self.out.push(')');
    }

    fn argument(&mut self, depth: usize) {
        if self.random.chance(6) {
            let name = self.random.one(&["kind = ", "x4=", "a = "]);
            self.put(name);
            return self.term(depth);
        }
        self.expr(depth);
    }

    fn index(&mut self, depth: usize) {
        self.out.push('[');
        self.list(depth, 1, Self::expr);
        self.symbol("]");
    }

    fn primary(&mut self, depth: usize) {
        let kinds = if depth == 0 { 4 } else { 8 };
        match self.random.below(kinds) {
            0 => self.number(),
            1 => self.name(),
            2 => {
                let coordinate = self.random.one(&["x1", "X2", "x16"]);
                self.put(coordinate);
            }
            3 => {
                let word = self.random.one(&["PI", "pi", "\"a { text\""]);
                self.put(word);
            }
            4 => {
                self.symbol("(");
                self.value(depth - 1);
                self.symbol(")");
            }
            5 => {
                self.symbol("[");
                self.list(depth - 1, 0, Self::expr);
                self.symbol("]");
            }
            6 => {
                let fold = self.random.one(&["SUM", "product", "Union", "ARRAY"]);
                self.put(fold);
                self.out.push_str("(i = ");
                self.expr(0);
                self.word("TO");
                self.expr(0);
                self.out.push(',');
                self.expr(depth - 1);
                self.symbol(")");
            }
            _ => {
                self.name();
                self.out.push('(');
                self.list(depth - 1, 0, Self::argument);
                self.symbol(")");
            }
        }
    }
}
