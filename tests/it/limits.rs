//! Every limit at n and at n + 1.

use std::sync::Arc;

use yont::host::{Host, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::syntax::Mode;

/// The messages of a program under these limits, errors only.
fn errors(limits: Limits, program: &str) -> Vec<String> {
    let host: Arc<dyn Host> = Arc::new(Memory::with(&[(
        "four.nrrd",
        b"NRRD0004\ntype: float\ndimension: 1\nsizes: 4\nencoding: ascii\n\n1 2 3 4\n",
    )]));
    let mut session = Session::new(host, limits, Interrupt::default());
    let outcome = session.input("limits.geo", program, Mode::Script);
    let errors = outcome.diagnostics.iter().filter(|diagnostic| diagnostic.is_error());
    let said: Vec<String> = errors.map(|diagnostic| format!("{diagnostic:?}")).collect();
    assert_eq!(outcome.accepted, said.is_empty(), "{said:?}");
    said
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
    let beyond = told(9);
    assert_eq!(beyond.len(), 5);
    assert!(beyond.last().is_some_and(|said| said.contains("5 more")), "the other five are counted: {beyond:?}");
}

#[test]
fn inputs_beyond_the_limit_cannot_be_undone() {
    let limits = Limits { undo_levels: 3, ..Limits::default() };
    let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
    for i in 0..5 {
        assert!(session.input("", &format!("a = {i};"), Mode::Prompt).accepted);
    }
    assert_eq!((0..5).filter(|_| session.undo().is_some()).count(), 3);
}

#[test]
fn a_data_file_beyond_the_limit_is_not_read() {
    let program = "a = INTERPOLATE(\"nearest\", \"four.nrrd\", 0);";
    let size = 67;
    let with = |data_bytes| errors(Limits { data_bytes, ..Limits::default() }, program);
    assert_eq!(with(1 << 20), Vec::<String>::new());
    assert!(with(size - 20).first().is_some_and(|said| said.contains("four.nrrd")));
}

#[test]
fn a_sum_of_a_million_terms_works() {
    let program = format!("a = 0{};", "+1".repeat(1_000_000));
    assert_eq!(errors(Limits::default(), &program), Vec::<String>::new());
    let limits = Limits { source_bytes: 1_000_000, ..Limits::default() };
    let refused = errors(limits, &program);
    assert!(refused.first().is_some_and(|said| said.contains("1000000")), "{refused:?}");
}
