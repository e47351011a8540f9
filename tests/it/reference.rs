//! The pages of `docs/` that are made, not written: the reference of built-in functions from their table, each example run, that of the
//! library from its comments, and the text of the gallery from the first comments of the examples. `UPDATE_EXPECT=1 cargo test --test it reference::` makes them anew.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use expect_test::expect_file;
use yont::builtins::{self, Builtin};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::library::{Entry, Library};
use yont::model::{Event, Session};
use yont::syntax::Mode;

use crate::examples::{commands, examples};
use crate::session::messages;

/// The value of an expression as a user sees it.
fn value(source: &str) -> String {
    let host = Memory::with(builtins::FILES);
    let mut session = Session::new(Arc::new(host), Limits::default(), Interrupt::default());
    let outcome = session.input("example", &format!("{source};"), Mode::Script);
    match outcome.events.as_slice() {
        [Event::Value { text, .. }] if outcome.accepted => text.clone(),
        _ => panic!("{source}: {}", messages(&outcome)),
    }
}

/// A heading as a link within the page.
fn anchor(heading: &str) -> String {
    heading.to_lowercase().replace(' ', "-")
}

/// A text in which nothing is taken for markup.
fn plain(text: &str) -> String {
    text.replace('*', "\\*").replace('_', "\\_").replace('|', "\\|").replace('<', "\\<")
}

fn entry(builtin: &Builtin) -> String {
    let source = builtin.example.0;
    let aliases = builtin.aliases.iter().map(|alias| format!("`{alias}`")).collect::<Vec<_>>().join(", ");
    let also = if aliases.is_empty() { String::new() } else { format!(" Also {aliases}.") };
    format!(
        "### `{}`\n\n{}{also}\n\n```geo\n{source};   // {}\n```\n\n",
        builtin.signature(),
        plain(builtin.doc),
        value(source)
    )
}

#[test]
fn the_page_of_built_in_functions_says_what_the_table_says() {
    let mut page = String::from(
        "# Built-in functions\n\nMade from the table that the interpreter works with; every example has been run. Names may be written in \
         either case, and are\ntaken only before `(`. `yont doc NAME` and `NAME?` at the prompt show the same.\n\n",
    );
    let mut subject = None;
    let mut body = String::new();
    for builtin in builtins::all() {
        if subject != Some(builtin.subject) {
            subject = Some(builtin.subject);
            let heading = builtin.subject.to_string();
            let heading = heading[..1].to_uppercase() + &heading[1..];
            let names: Vec<_> =
                builtins::all().filter(|b| b.subject == builtin.subject).map(|b| format!("`{}`", b.name)).collect();
            writeln!(page, "- [{heading}](#{}): {}", anchor(&heading), names.join(" ")).expect("a text has room");
            write!(body, "## {heading}\n\n").expect("a text has room");
        }
        body.push_str(&entry(builtin));
    }
    expect_file!["../../docs/builtins.md"].assert_eq(&format!("{page}\n{}\n", body.trim_end()));
}

/// An entry of the library: what its comment says.
fn library_entry(entry: &Entry) -> String {
    let (example, value) = &entry.example;
    let source = if entry.source.is_empty() { String::new() } else { format!("Source: {}\n\n", plain(&entry.source)) };
    let (signature, text) = (&entry.signature, plain(&entry.text));
    format!("### `{signature}`\n\n{text}\n\n```geo\n{example};   // {value}\n```\n\n{source}")
}

#[test]
fn the_page_of_the_library_says_what_its_comments_say() {
    let mut page = String::from(
        "# The library\n\nMade from the comments of `stdlib/`; every example has been run. Every session knows these names; those of the user's own \
         win over\nthem, and `--no-prelude` starts without any. Angles are radians, points and vectors are arrays, and all objects are positive \
         inside.\n`yont doc NAME` and `NAME?` at the prompt show the same, `NAME??` the definition. The pictures show the examples, \
         made by `.ci/library`.\n\n",
    );
    let library = Library::shared();
    let mut body = String::new();
    for (heading, names) in library.subjects() {
        let entries: Vec<Entry> = names.iter().filter_map(|name| library.entry(name)).collect();
        let listed: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        writeln!(page, "- [{heading}](#{}): {}", anchor(&heading.replace(',', "")), listed.join(" "))
            .expect("a text has room");
        write!(body, "## {heading}\n\n").expect("a text has room");
        let stem = entries.first().map(|entry| entry.file.rsplit(['/', '.']).nth(1).unwrap_or_default().to_owned());
        let picture = format!("pictures/library/{}.png", stem.unwrap_or_default());
        if Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(&picture).exists() {
            write!(body, "![{heading}]({picture})\n\n").expect("a text has room");
        }
        body.extend(entries.iter().map(library_entry));
    }
    expect_file!["../../docs/library.md"].assert_eq(&format!("{page}\n{}\n", body.trim_end()));
}

/// The paragraphs of an example's first comment up to `Shows:`, and its command lines.
fn gallery_entry(name: &str, text: &str) -> String {
    let stem = name.strip_suffix(".geo").unwrap_or(name);
    let comment = text.split('}').next().expect("a comment at the top");
    let prose = comment.trim_start_matches('{').split("Shows:").next().unwrap_or_default();
    let mut paragraphs = prose.split("\n\n").map(|p| p.split_whitespace().collect::<Vec<_>>().join(" "));
    let title = paragraphs.next().unwrap_or_default();
    let rest: String = paragraphs.filter(|p| !p.is_empty()).map(|p| plain(&p) + "\n\n").collect();
    let picture = ["gif", "png"].map(|end| format!("pictures/{stem}.{end}"));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let picture = picture.iter().find(|p| folder.join(p).exists());
    let picture = picture.unwrap_or_else(|| panic!("no picture of {name}: run .ci/gallery"));
    let run: String = commands(text).iter().map(|words| words.join(" ") + "\n").collect();
    format!(
        "## {stem}\n\n**{}**\n\n![{stem}]({picture})\n\n{rest}```sh\n{}```\n\n[The program](../examples/{name})\n",
        plain(&title),
        run
    )
}

#[test]
fn the_gallery_shows_every_example() {
    let all = examples();
    let entries: Vec<String> = all.iter().map(|(name, text)| gallery_entry(name, text)).collect();
    let page = format!(
        "# Gallery\n\nAll examples in the order of the folder, with a picture of each, which `.ci/gallery` makes of them. \
         The first comment of each\nprogram says more: what it shows, and which numbers to expect.\n\n{}",
        entries.join("\n")
    );
    expect_file!["../../docs/gallery.md"].assert_eq(&page);
}
