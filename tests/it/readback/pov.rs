//! A strict reader of POV-Ray scenes as far as we write them: the language of functions with its precedences, its calls by value and its
//! limits, isosurfaces and meshes. Panics at the first thing that POV-Ray would refuse or read otherwise. Shares no code with the writer.

use std::collections::BTreeMap;

use yont::surface::Mesh;

use super::files::Read;

/// Functions of POV-Ray's language that take so many arguments.
const BUILT_IN: &[(&str, usize, usize)] = &[
    ("abs", 1, 1),
    ("sqrt", 1, 1),
    ("exp", 1, 1),
    ("ln", 1, 1),
    ("log", 1, 1),
    ("sin", 1, 1),
    ("cos", 1, 1),
    ("tan", 1, 1),
    ("asin", 1, 1),
    ("acos", 1, 1),
    ("atan", 1, 1),
    ("sinh", 1, 1),
    ("cosh", 1, 1),
    ("tanh", 1, 1),
    ("asinh", 1, 1),
    ("acosh", 1, 1),
    ("atanh", 1, 1),
    ("floor", 1, 1),
    ("ceil", 1, 1),
    ("atan2", 2, 2),
    ("pow", 2, 2),
    ("min", 2, 99),
    ("max", 2, 99),
    ("select", 3, 4),
];
/// Parameters of a function that POV-Ray takes.
const PARAMETERS: usize = 56;
/// Functions within functions that it takes.
const CALLS: usize = 1000;

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Word(String),
    Number(f64),
    Sign(&'static str),
}

const SIGNS: &[&str] =
    &["<=", ">=", "!=", "#", "{", "}", "(", ")", "<", ">", "[", "]", ",", ";", "+", "-", "*", "/", "=", "&", "|", "."];

fn tokens(text: &str) -> Vec<Token> {
    let mut all = Vec::new();
    for line in text.lines() {
        let mut rest = line.split("//").next().unwrap_or_default();
        while let Some(first) = rest.chars().next() {
            let taken = if first.is_whitespace() {
                1
            } else if first.is_ascii_alphabetic() || first == '_' {
                let word: String = rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
                assert!(word.len() <= 40, "{word} is too long a name");
                all.push(Token::Word(word.clone()));
                word.len()
            } else if first.is_ascii_digit() {
                let length = digits(rest);
                all.push(Token::Number(rest[..length].parse().unwrap_or_else(|_| panic!("{line}"))));
                length
            } else {
                let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign)).unwrap_or_else(|| panic!("{line}"));
                all.push(Token::Sign(sign));
                sign.len()
            };
            rest = &rest[taken..];
        }
    }
    all
}

/// The length of the number at the beginning of the text.
fn digits(text: &str) -> usize {
    let run = |at: usize| text[at..].bytes().take_while(u8::is_ascii_digit).count();
    let mut end = run(0);
    if text[end..].starts_with('.') && run(end + 1) > 0 {
        end += 1 + run(end + 1);
    }
    if text[end..].starts_with('e') {
        let sign = usize::from(text[end + 1..].starts_with('-'));
        assert!(run(end + 1 + sign) > 0, "an exponent has digits: {text}");
        end += 1 + sign + run(end + 1 + sign);
    }
    end
}

#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    Parameter(usize),
    Negative(Box<Tree>),
    Two(&'static str, Box<Tree>, Box<Tree>),
    BuiltIn(String, Vec<Tree>),
    Call(String, Vec<Tree>),
}

#[derive(Debug)]
struct Function {
    parameters: Vec<String>,
    value: Tree,
}

/// An isosurface: its function of x, y and z, where it is looked for, and how steep it says it is.
#[derive(Debug)]
pub struct Isosurface {
    value: Tree,
    pub lo: [f64; 3],
    pub hi: [f64; 3],
    pub max_gradient: f64,
    /// Red, green and blue, linear, if the colour differs from point to point.
    colours: Vec<Tree>,
}

/// What a scene holds.
#[derive(Debug, Default)]
pub struct Scene {
    pub read: Read,
    /// One for each object that is a formula, with its place among the meshes.
    pub isosurfaces: Vec<(usize, Isosurface)>,
    functions: BTreeMap<String, Function>,
    /// Camera: location, direction, right and up for a square picture.
    pub camera: [[f64; 3]; 4],
    pub lights: usize,
}

impl Scene {
    /// The isosurface's function at a point: negative inside.
    pub fn value(&self, of: &Isosurface, at: [f64; 3]) -> f64 {
        self.evaluate(&of.value, &at, 0)
    }

    /// Its colour there, linear light.
    pub fn colour(&self, of: &Isosurface, at: [f64; 3]) -> Vec<f64> {
        of.colours.iter().map(|colour| self.evaluate(colour, &at, 0)).collect()
    }

    fn evaluate(&self, tree: &Tree, given: &[f64], depth: usize) -> f64 {
        assert!(depth < CALLS, "functions within functions");
        let of = |tree: &Tree| self.evaluate(tree, given, depth);
        match tree {
            Tree::Number(value) => *value,
            Tree::Parameter(at) => given[*at],
            Tree::Negative(a) => -of(a),
            Tree::Two(sign, a, b) => {
                let (a, b) = (of(a), of(b));
                let truth = |holds: bool| f64::from(u8::from(holds));
                match *sign {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    "/" => a / b,
                    "<" => truth(a < b),
                    "<=" => truth(a <= b),
                    "=" => truth(a == b),
                    "!=" => truth(a != b),
                    "&" => truth(a != 0.0 && b != 0.0),
                    _ => truth(a != 0.0 || b != 0.0),
                }
            }
            Tree::BuiltIn(name, arguments) if name == "select" => {
                let condition = of(&arguments[0]);
                let last = if condition == 0.0 { 2 } else { arguments.len() - 1 };
                of(&arguments[if condition < 0.0 { 1 } else { last }])
            }
            Tree::BuiltIn(name, arguments) => {
                let all: Vec<f64> = arguments.iter().map(of).collect();
                built_in(name, &all)
            }
            Tree::Call(name, arguments) => {
                let given: Vec<f64> = arguments.iter().map(of).collect();
                self.evaluate(&self.functions[name].value, &given, depth + 1)
            }
        }
    }
}

fn built_in(name: &str, all: &[f64]) -> f64 {
    let a = all[0];
    let arc = [("asin", f64::asin as fn(f64) -> f64), ("acos", f64::acos), ("atan", f64::atan)];
    if let Some((_, arc)) = arc.iter().find(|arc| arc.0 == name) {
        return arc(a);
    }
    match name {
        "abs" => a.abs(),
        "sqrt" => a.sqrt(),
        "exp" => a.exp(),
        "ln" => a.ln(),
        "log" => a.log10(),
        "sin" => a.sin(),
        "cos" => a.cos(),
        "tan" => a.tan(),
        "sinh" => a.sinh(),
        "cosh" => a.cosh(),
        "tanh" => a.tanh(),
        "asinh" => a.asinh(),
        "acosh" => a.acosh(),
        "atanh" => a.atanh(),
        "floor" => a.floor(),
        "ceil" => a.ceil(),
        "atan2" => a.atan2(all[1]),
        "pow" => a.powf(all[1]),
        "min" => all.iter().copied().fold(f64::INFINITY, f64::min),
        _ => all.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    }
}

struct Reader {
    tokens: Vec<Token>,
    at: usize,
    functions: BTreeMap<String, Function>,
}

impl Reader {
    fn is(&self, sign: &str) -> bool {
        matches!(self.tokens.get(self.at), Some(Token::Sign(s)) if *s == sign)
    }

    fn accept(&mut self, sign: &str) -> bool {
        let is = self.is(sign);
        self.at += usize::from(is);
        is
    }

    fn sign(&mut self, sign: &str) {
        assert!(self.accept(sign), "{sign} before {:?}", &self.tokens[self.at..self.tokens.len().min(self.at + 9)]);
    }

    fn is_word(&self, word: &str) -> bool {
        matches!(self.tokens.get(self.at), Some(Token::Word(w)) if w == word)
    }

    fn accept_word(&mut self, word: &str) -> bool {
        let is = self.is_word(word);
        self.at += usize::from(is);
        is
    }

    fn word(&mut self, word: &str) {
        assert!(
            self.accept_word(word),
            "{word} before {:?}",
            &self.tokens[self.at..self.tokens.len().min(self.at + 9)]
        );
    }

    fn name(&mut self) -> String {
        let Some(Token::Word(name)) = self.tokens.get(self.at).cloned() else { panic!("a name at {}", self.at) };
        self.at += 1;
        name
    }

    fn number(&mut self) -> f64 {
        let sign = if self.accept("-") { -1.0 } else { 1.0 };
        let Some(Token::Number(value)) = self.tokens.get(self.at) else {
            panic!("a number: {:?}", self.tokens[self.at])
        };
        self.at += 1;
        sign * value
    }

    fn count(&mut self) -> usize {
        self.number() as usize
    }

    fn vector(&mut self) -> [f64; 3] {
        self.sign("<");
        let vector = std::array::from_fn(|k| {
            if k > 0 {
                self.sign(",");
            }
            self.number()
        });
        self.sign(">");
        vector
    }

    /// `{ N, item, item ... }`
    fn list<T>(&mut self, keyword: &str, item: impl Fn(&mut Self) -> T) -> Vec<T> {
        self.word(keyword);
        self.sign("{");
        let count = self.count();
        let items = (0..count).map(|_| {
            self.sign(",");
            item(self)
        });
        let items = items.collect();
        self.sign("}");
        items
    }

    /// An operand and all operators behind it that bind at least so tightly.
    fn expression(&mut self, least: u8, parameters: &[String]) -> Tree {
        let mut left = self.operand(parameters);
        loop {
            let found = match self.tokens.get(self.at) {
                Some(Token::Sign(sign)) => *sign,
                _ => return left,
            };
            let binding = match found {
                "|" => 1,
                "&" => 2,
                "=" | "!=" | "<" | "<=" => 3,
                "+" | "-" => 4,
                "*" | "/" => 5,
                _ => return left,
            };
            if binding < least {
                return left;
            }
            self.at += 1;
            let right = self.expression(binding + 1, parameters);
            left = Tree::Two(found, Box::new(left), Box::new(right));
        }
    }

    fn operand(&mut self, parameters: &[String]) -> Tree {
        if self.accept("-") {
            assert!(!self.is("-"), "one sign");
            return Tree::Negative(Box::new(self.operand(parameters)));
        }
        if self.accept("(") {
            let inner = self.expression(0, parameters);
            self.sign(")");
            return inner;
        }
        if let Some(Token::Number(value)) = self.tokens.get(self.at) {
            self.at += 1;
            return Tree::Number(*value);
        }
        let name = self.name();
        if !self.is("(") {
            let at = parameters.iter().position(|parameter| *parameter == name);
            return Tree::Parameter(at.unwrap_or_else(|| panic!("{name} is no parameter of {parameters:?}")));
        }
        let mut arguments = Vec::new();
        while self.accept(if arguments.is_empty() { "(" } else { "," }) {
            arguments.push(self.expression(0, parameters));
        }
        self.sign(")");
        if let Some((_, least, most)) = BUILT_IN.iter().find(|known| known.0 == name) {
            assert!((*least..=*most).contains(&arguments.len()), "{name} of {} arguments", arguments.len());
            return Tree::BuiltIn(name, arguments);
        }
        // A function must be declared before it is called, and so cannot call itself.
        let function = self.functions.get(&name).unwrap_or_else(|| panic!("{name} is not declared"));
        assert_eq!(function.parameters.len(), arguments.len(), "{name}");
        Tree::Call(name, arguments)
    }

    /// `(a, b) { expression }`
    fn function(&mut self) -> Function {
        let mut parameters = Vec::new();
        while self.accept(if parameters.is_empty() { "(" } else { "," }) {
            let name = self.name();
            let is_known = BUILT_IN.iter().any(|known| known.0 == name) || self.functions.contains_key(&name);
            assert!(!is_known && !parameters.contains(&name), "{name} has a meaning");
            parameters.push(name);
        }
        self.sign(")");
        assert!((1..=PARAMETERS).contains(&parameters.len()), "{} parameters", parameters.len());
        let value = self.braced(&parameters);
        Function { parameters, value }
    }

    fn braced(&mut self, parameters: &[String]) -> Tree {
        self.sign("{");
        let value = self.expression(0, parameters);
        self.sign("}");
        value
    }

    fn space(&mut self) -> Tree {
        self.word("function");
        self.braced(&["x", "y", "z"].map(String::from))
    }

    fn isosurface(&mut self) -> Isosurface {
        self.word("isosurface");
        self.sign("{");
        let value = self.space();
        self.word("contained_by");
        self.sign("{");
        self.word("box");
        self.sign("{");
        let lo = self.vector();
        self.sign(",");
        let hi = self.vector();
        self.sign("}");
        self.sign("}");
        self.word("threshold");
        assert_eq!(self.number(), 0.0);
        self.word("accuracy");
        let accuracy = self.number();
        let longest = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
        assert!(accuracy > 0.0 && accuracy < 1e-4 * longest, "accuracy {accuracy}");
        self.word("max_gradient");
        let max_gradient = self.number();
        assert!(max_gradient > 0.0 && max_gradient.is_finite(), "max_gradient {max_gradient}");
        let colours = self.texture().1;
        self.sign("}");
        Isosurface { value, lo, hi, max_gradient, colours }
    }

    /// A texture: its colour, or the functions of it.
    fn texture(&mut self) -> ([f64; 3], Vec<Tree>) {
        self.word("texture");
        self.sign("{");
        self.word("pigment");
        self.sign("{");
        let mut of = ([0.0; 3], Vec::new());
        if self.accept_word("rgb") {
            of.0 = self.vector();
        } else {
            self.word("average");
            self.word("pigment_map");
            self.sign("{");
            for k in 0..3 {
                self.sign("[");
                assert_eq!(self.number(), 1.0);
                of.1.push(self.space());
                self.word("color_map");
                self.sign("{");
                for (end, colour) in [(0.0, 0.0), (1.0, 3.0)] {
                    self.sign("[");
                    assert_eq!(self.number(), end);
                    self.word("rgb");
                    if end == 0.0 {
                        assert_eq!(self.number(), 0.0);
                    } else {
                        assert_eq!(self.vector(), std::array::from_fn(|i| if i == k { colour } else { 0.0 }));
                    }
                    self.sign("]");
                }
                self.sign("}");
                self.sign("]");
            }
            self.sign("}");
        }
        self.sign("}");
        self.word("finish");
        self.sign("{");
        self.word("Yont_Finish");
        self.sign("}");
        self.sign("}");
        of
    }

    fn mesh(&mut self, read: &mut Read) {
        self.word("mesh2");
        self.sign("{");
        let positions = self.list("vertex_vectors", Self::vector);
        let normals =
            if self.is_word("normal_vectors") { self.list("normal_vectors", Self::vector) } else { Vec::new() };
        let textures = if self.is_word("texture_list") {
            self.list("texture_list", |reader| reader.texture().0)
        } else {
            Vec::new()
        };
        let corner = |reader: &mut Self| {
            let corners = reader.vector();
            let mut of = [0usize; 3];
            for of in of.iter_mut().filter(|_| !textures.is_empty()) {
                reader.sign(",");
                *of = reader.count();
                assert!(*of < textures.len(), "texture {of} of {}", textures.len());
            }
            let triangle = corners.map(|v| {
                assert!(v >= 0.0 && v.fract() == 0.0 && (v as usize) < positions.len(), "vertex {v}");
                v as u32
            });
            (triangle, of)
        };
        let faces = self.list("face_indices", corner);
        self.word("inside_vector");
        self.vector();
        let plain = textures.is_empty().then(|| self.texture().0);
        self.sign("}");
        let mut colours = vec![[0u8; 3]; if textures.is_empty() { 0 } else { positions.len() }];
        for (triangle, of) in &faces {
            for (v, texture) in triangle.iter().zip(of).filter(|_| plain.is_none()) {
                colours[*v as usize] = textures[*texture].map(byte);
            }
        }
        if let Some(plain) = plain {
            colours = vec![plain.map(byte)];
        }
        let triangles = faces.into_iter().map(|face| face.0).collect();
        read.meshes.push((String::new(), Mesh { positions, normals, triangles }));
        read.colours.push(colours);
    }

    /// Skips `{ ... }`.
    fn block(&mut self) {
        self.sign("{");
        let mut depth = 1;
        while depth > 0 {
            depth += i32::from(self.is("{"));
            depth -= i32::from(self.is("}"));
            self.at += 1;
        }
    }
}

/// The sRGB byte of linear light.
fn byte(light: f64) -> u8 {
    let v = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (v * 255.0).round() as u8
}

/// Reads a scene. An object of one colour has one colour, one of several a colour for each vertex.
pub fn read(bytes: &[u8]) -> Scene {
    let text = std::str::from_utf8(bytes).expect("text");
    let mut reader = Reader { tokens: tokens(text), at: 0, functions: BTreeMap::new() };
    let mut scene = Scene::default();
    let mut open = 0;
    while reader.at < reader.tokens.len() {
        if reader.accept("#") {
            match reader.name().as_str() {
                "version" => {
                    assert_eq!(reader.number(), 3.7);
                    reader.sign(";");
                }
                "declare" => declare(&mut reader),
                "ifndef" | "if" => {
                    open += 1;
                    reader.sign("(");
                    reader.word("Yont_Isosurface");
                    reader.sign(")");
                }
                "else" => assert!(open > 0),
                "end" => open -= 1,
                other => panic!("#{other}"),
            }
        } else if reader.is_word("isosurface") {
            let found = reader.isosurface();
            scene.isosurfaces.push((scene.read.meshes.len(), found));
        } else if reader.is_word("mesh2") {
            reader.mesh(&mut scene.read);
        } else if reader.accept_word("camera") {
            scene.camera = camera(&mut reader);
        } else {
            let name = reader.name();
            assert!(["global_settings", "background", "light_source"].contains(&name.as_str()), "{name}");
            scene.lights += usize::from(name == "light_source");
            reader.block();
        }
    }
    assert_eq!(open, 0, "what begins with #if ends");
    scene.functions = reader.functions;
    scene
}

fn declare(reader: &mut Reader) {
    let name = reader.name();
    reader.sign("=");
    if reader.accept_word("function") {
        let function = reader.function();
        assert!(reader.functions.insert(name.clone(), function).is_none(), "{name} is declared twice");
        return;
    }
    match name.as_str() {
        "Yont_Isosurface" => {
            assert_eq!(reader.number(), 0.0);
            reader.sign(";");
        }
        "Yont_Finish" => {
            reader.word("finish");
            reader.block();
        }
        "Yont_Aspect" | "Yont_Zoom" => {
            while !reader.accept(";") {
                reader.at += 1;
            }
        }
        other => panic!("{other}"),
    }
}

fn camera(reader: &mut Reader) -> [[f64; 3]; 4] {
    reader.sign("{");
    let kind = reader.name();
    assert!(["perspective", "orthographic"].contains(&kind.as_str()));
    let mut camera = [[0.0; 3]; 4];
    for (keyword, vector) in ["location", "direction", "right", "up"].iter().zip(&mut camera) {
        reader.word(keyword);
        while reader.accept_word("Yont_Zoom") || reader.accept_word("Yont_Aspect") {
            reader.sign("*");
        }
        *vector = reader.vector();
    }
    reader.sign("}");
    camera
}
