//! Every limit at n and at n + 1.

use std::sync::Arc;

use yont::host::{Host, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, Options, Output, Timing, View};
use yont::syntax::Mode;

/// A volume of four samples.
const FOUR: &[u8] = b"NRRD0004\ntype: float\ndimension: 1\nsizes: 4\nencoding: ascii\n\n1 2 3 4\n";

/// The messages of a program under these limits, errors only.
fn errors(limits: Limits, program: &str) -> Vec<String> {
    let host: Arc<dyn Host> = Arc::new(Memory::with(&[("four.nrrd", FOUR)]));
    let mut session = Session::new(host, limits, Interrupt::default());
    let outcome = session.input("limits.geo", program, Mode::Script);
    let errors = outcome.diagnostics.iter().filter(|diagnostic| diagnostic.is_error());
    let said: Vec<String> = errors.map(|diagnostic| format!("{diagnostic:?}")).collect();
    assert_eq!(outcome.accepted, said.is_empty(), "{said:?}");
    said
}

/// A session under these limits that has taken a program.
fn defined(limits: Limits, program: &str) -> Session {
    let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
    assert!(session.input("limits.geo", program, Mode::Script).accepted, "{program}");
    session
}

/// One limit: how it is set, and a program that needs a given amount of it.
type Case = (&'static str, usize, fn(&mut Limits, usize), fn(usize) -> String);

const CASES: &[Case] = &[
    ("source_bytes", 100, |limits, n| limits.source_bytes = n, |n| format!("a = 1;{}", " ".repeat(n - 6))),
    ("nesting", 50, |limits, n| limits.nesting = n, |n| format!("a = {}1{};", "(".repeat(n), ")".repeat(n))),
    ("nesting of arrays", 50, |limits, n| limits.nesting = n, |n| format!("a = {}1{};", "[".repeat(n), "]".repeat(n))),
    (
        "call_depth",
        30,
        |limits, n| limits.call_depth = n,
        |n| format!("f(n) = IF (n <= 1) THEN 1 ELSE f(n - 1) + 1; a = f({n});"),
    ),
    ("loop_turns", 40, |limits, n| limits.loop_turns = n, |n| format!("a = 0; FOR i = 1 TO {n} DO a = a + i;")),
    ("loop_turns of WHILE", 40, |limits, n| limits.loop_turns = n, |n| format!("i = 0; WHILE (i < {n}) DO i = i + 1;")),
    ("loop_turns of SUM", 40, |limits, n| limits.loop_turns = n, |n| format!("a = SUM(i = 1 TO {n}, i);")),
    ("array_elements", 20, |limits, n| limits.array_elements = n, |n| format!("a = ARRAY(i = 1 TO {n}, i);")),
    (
        "array_elements of a literal",
        20,
        |limits, n| limits.array_elements = n,
        |n| format!("a = [{}0];", "0, ".repeat(n - 1)),
    ),
];

#[test]
fn at_n_it_works_and_at_n_plus_1_it_is_refused_with_the_number() {
    for (what, n, set, program) in CASES {
        let mut limits = Limits::default();
        set(&mut limits, *n);
        let within = errors(limits.clone(), &program(*n));
        assert!(within.is_empty(), "{what} at {n}: {within:?}");
        let beyond = errors(limits, &program(*n + 1));
        assert!(beyond.len() == 1, "{what} at {}: {beyond:?}", *n + 1);
        assert!(beyond[0].contains(&n.to_string()), "{what}: does not name the limit {n}: {}", beyond[0]);
    }
}

#[test]
fn errors_beyond_the_limit_are_counted() {
    let limits = Limits { errors: 5, ..Limits::default() };
    let bad = |count: usize| (0..count).map(|i| format!("a{i} = nowhere{i} + 1;\n")).collect::<String>();
    let told = |count: usize| errors(limits.clone(), &bad(count));
    assert_eq!(told(5).iter().filter(|said| said.contains("nowhere")).count(), 5);
    for (count, others) in [(6, "2 more"), (9, "5 more")] {
        let beyond = told(count);
        assert_eq!(beyond.len(), 5);
        assert!(beyond.last().is_some_and(|said| said.contains(others)), "the others are counted: {beyond:?}");
    }
}

#[test]
fn inputs_beyond_the_limit_cannot_be_undone() {
    for (inputs, undone) in [(2, 2), (3, 3), (4, 3)] {
        let limits = Limits { undo_levels: 3, ..Limits::default() };
        let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
        for i in 0..inputs {
            assert!(session.input("", &format!("a = {i};"), Mode::Prompt).accepted);
        }
        assert_eq!((0..5).filter(|_| session.undo().is_some()).count(), undone);
    }
}

#[test]
fn a_data_file_beyond_the_limit_is_not_read() {
    let program = "a = INTERPOLATE(\"nearest\", \"four.nrrd\", 0);";
    let size = FOUR.len();
    let with = |data_bytes| errors(Limits { data_bytes, ..Limits::default() }, program);
    assert_eq!(with(size), Vec::<String>::new());
    let refused = with(size - 1);
    assert!(refused[0].contains("four.nrrd") && refused[0].contains(&(size - 1).to_string()), "{refused:?}");
}

/// The smallest number in a range that will do, if all larger ones do.
fn least(mut lo: usize, mut hi: usize, fits: impl Fn(usize) -> bool) -> usize {
    while lo < hi {
        let middle = lo + (hi - lo) / 2;
        if fits(middle) { hi = middle } else { lo = middle + 1 }
    }
    lo
}

#[test]
fn a_session_of_too_many_nodes_is_refused() {
    let program = "gob_a = 1; FOR i = 1 TO 20 DO gob_a = gob_a + SIN(i*x1);";
    let with = |graph_nodes| errors(Limits { graph_nodes, ..Limits::default() }, program);
    let enough = least(1, 5000, |n| with(n).is_empty());
    assert!((20..200).contains(&enough), "{enough}");
    let refused = with(enough - 1);
    assert!(refused.len() == 1 && refused[0].contains(&format!("more than {} operations", enough - 1)), "{refused:?}");
}

#[test]
fn a_question_of_too_many_boxes_is_not_decided() {
    let program = "a = INTERSECTS(pob_sphere([0, 0, 0], 1), pob_sphere([2.0001, 0.1, 0.2], 1.01));";
    let with = |question_boxes| errors(Limits { question_boxes, ..Limits::default() }, program);
    let enough = least(1, 5000, |n| with(n).is_empty());
    assert!((2..4000).contains(&enough), "{enough}");
    let refused = with(enough - 1);
    assert!(refused.len() == 1 && refused[0].contains(&format!("{} boxes", enough - 1)), "{refused:?}");
}

/// What `-o` answers under these limits: nothing, or its messages.
fn output(limits: Limits, program: &str, to: &str, set: impl Fn(&mut Options)) -> Vec<String> {
    let host = Arc::new(Memory::default());
    let mut session = Session::new(host.clone(), limits, Interrupt::default());
    assert!(session.input("limits.geo", program, Mode::Script).accepted, "{program}");
    let mut options = Options::default();
    options.view.cells = Cells::Along(6);
    options.picture.size = Some((12, 9));
    set(&mut options);
    let output = Output::parse(to, None).expect("an output");
    let written = request::write(&mut session, &output, &options, &mut Vec::new());
    let told: Vec<String> = written.err().into_iter().flatten().map(|d| format!("{d:?}")).collect();
    assert_eq!(host.names().is_empty(), !told.is_empty(), "a file or a message");
    told
}

const SPACE: &str = "x1min = -2; x1max = 2; x2min = -2; x2max = 2; x3min = -2; x3max = 2;";

/// Limits of what is made: which, the program and the output of so many, the options, and the words that name the limit `{}`.
type Making = (&'static str, fn(usize) -> String, &'static str, fn(&mut Options, usize), &'static str);

const MAKING: &[Making] = &[
    (
        "frames of T",
        |n| format!("gob_a = 1 + x4 - x1**2 - x2**2; x4min = 0; x4max = {}; x4_delta = 1;", n - 1),
        "a.gif",
        |_, _| {},
        "more than {} values of x4",
    ),
    (
        "numbered frames",
        |n| format!("gob_a = 1 + x4 - x1**2 - x2**2; x4min = 0; x4max = {}; x4_delta = -1;", n - 1),
        "a{n}.svg",
        |_, _| {},
        "more than {} values of x4",
    ),
    (
        "--frames",
        |_| "gob_a = 1 + x4 - x1**2 - x2**2; x4min = 0; x4max = 1;".into(),
        "a.apng",
        |options, n| options.timing.frames = Some(n),
        "more than {} values of x4",
    ),
    (
        "columns",
        |n| format!("gob_a = x5 - x1**2 - x2**2; x5 : V; x5min = 1; x5max = {n}; x5_delta = 1;"),
        "a.png",
        |_, _| {},
        "more than {} values of x5",
    ),
    (
        "a group",
        |n| format!("gob_a = x5 - x1**2 - x2**2; x5 : G = [{}1];", "1, ".repeat(n - 1)),
        "a.png",
        |_, _| {},
        "more than {} values of x5",
    ),
];

#[test]
fn at_n_it_is_made_and_at_n_plus_1_it_is_refused_with_the_number() {
    let n = 5;
    let limits = || Limits { frames: n, ..Limits::default() };
    for (what, program, to, set, words) in MAKING {
        let with = |many| output(limits(), &(program(many) + &SPACE[..46]), to, |options| set(options, many));
        assert_eq!(with(n), Vec::<String>::new(), "{what} at {n}");
        let refused = with(n + 1);
        assert!(refused.len() == 1 && refused[0].contains(&words.replace("{}", &n.to_string())), "{what}: {refused:?}");
    }
    let groups = |a: usize, b: usize| {
        let list = |many: usize| format!("[{}1]", "1, ".repeat(many - 1));
        format!("gob_a = x5*x6 - x1**2 - x2**2; x5 : G = {}; x6 : G = {}; {}", list(a), list(b), &SPACE[..46])
    };
    let six = || Limits { frames: 6, ..Limits::default() };
    assert_eq!(output(six(), &groups(3, 2), "a.png", |_| {}), Vec::<String>::new());
    assert!(output(six(), &groups(4, 2), "a.png", |_| {})[0].contains("more than 6 sections"));
}

#[test]
fn pictures_have_a_largest_side_and_work_has_a_memory() {
    let program = format!("gob_a = 1 - x1**2 - x2**2; {}", &SPACE[..46]);
    let side = |size| {
        output(Limits { picture_side: 20, ..Limits::default() }, &program, "a.png", |o| o.picture.size = Some(size))
    };
    for (within, beyond) in [((20, 1), (21, 1)), ((1, 20), (1, 21))] {
        assert_eq!(side(within), Vec::<String>::new());
        assert!(side(beyond)[0].contains("1 to 20 pixels"), "{beyond:?}");
    }
    for (program, to) in [
        (program.clone(), "a.png"),
        (program, "a.nrrd"),
        (format!("gob_a = 1 - x1**2 - x2**2 - x3**2; {SPACE}"), "a.stl"),
    ] {
        let with = |memory_bytes| output(Limits { memory_bytes, ..Limits::default() }, &program, to, |_| {});
        let enough = least(1, 64 << 20, |n| with(n).is_empty());
        assert!(enough > 100, "{to}: {enough}");
        assert!(with(enough - 1)[0].contains("memory"), "{to}: {:?}", with(enough - 1));
    }
}

#[test]
fn a_sum_of_a_million_terms_works() {
    let program = format!("a = 0{};", "+1".repeat(1_000_000));
    assert_eq!(errors(Limits::default(), &program), Vec::<String>::new());
    let limits = Limits { source_bytes: 1_000_000, ..Limits::default() };
    let refused = errors(limits, &program);
    assert!(refused.first().is_some_and(|said| said.contains("1000000")), "{refused:?}");
}

/// A loop whose turns differ from point to point, at the number of turns that a point may take and one beyond.
#[test]
fn a_point_takes_so_many_turns_and_is_undefined_beyond() {
    let values = |point_turns| {
        let limits = Limits { point_turns, ..Limits::default() };
        let mut session = defined(limits, "n = 0; WHILE (n < x1) DO n = n + 1; gob_a = n;");
        let points = [vec![30.0], vec![31.0]];
        let sampled = request::sample(&mut session, &View::default(), &points, false).expect("values");
        sampled.iter().map(|sample| sample.value).collect::<Vec<f64>>()
    };
    for n in [30, 31] {
        let found = values(n);
        assert_eq!(found[0], 30.0, "{n} turns");
        assert!(if n == 30 { found[1].is_nan() } else { found[1] == 31.0 }, "{n} turns: {found:?}");
    }
}

/// A search that looks into too few pieces misses a peak, and with a piece more it finds it.
#[test]
fn a_section_is_looked_at_in_so_many_pieces() {
    let highest = |section_pieces| {
        let limits = Limits { section_pieces, ..Limits::default() };
        let mut session = defined(limits, "gob_a = PROJECT(EXP(-(3000*(x4 - x1))**2) + 0.1*SIN(x4), x4, -3, 3);");
        request::sample(&mut session, &View::default(), &[vec![0.7]], false).expect("a value")[0].value
    };
    let peak = 1.0 + 0.1 * 0.7_f64.sin();
    let finds = |n: usize| (highest(n) - peak).abs() < 1e-3;
    let enough = least(0, Limits::default().section_pieces, finds);
    assert!(enough > 0 && finds(enough) && !finds(enough - 1), "{enough}");
}

/// The space of an object is proved with so much work, and a guess with less.
#[test]
fn a_space_is_sought_with_so_much_work() {
    let code = |search_operations| {
        let limits = Limits { search_operations, ..Limits::default() };
        let mut session = defined(limits, "gob_a = 1 - x1**2 - x2**2;");
        let subject = request::subject(&mut session, &View::default(), &Timing::default()).expect("a space");
        subject.notes[0].code
    };
    let proves = |n: usize| code(n) == "space-found";
    let enough = least(1, Limits::default().search_operations, proves);
    assert!(enough > 100 && proves(enough), "{enough}");
    assert_eq!(code(enough - 1), "space-guessed");
}

#[test]
fn an_object_of_n_operations_is_a_formula_of_pov_ray_and_one_of_n_plus_1_is_a_mesh() {
    // Three squares, their sum and a difference.
    let program = format!("gob_a = 1 - (x1**2 + x2**2 + x3**2); {SPACE}");
    for (limit, is_formula) in [(6, true), (5, false)] {
        let mut session = defined(Limits { pov_operations: limit, ..Limits::default() }, &program);
        let output = Output::parse("-", Some(request::Format::Pov)).expect("a format");
        let mut options = Options::default();
        options.view.cells = Cells::Along(8);
        let mut bytes = Vec::new();
        request::write(&mut session, &output, &options, &mut bytes).expect("a scene");
        let text = String::from_utf8(bytes).expect("text");
        assert_eq!(text.contains("isosurface {"), is_formula, "{limit}");
        assert_eq!(text.contains(&format!("its 6 operations are more than {limit}")), !is_formula, "{limit}");
    }
}
