//! Cases of the self-test, run on a renderer that is opened for them.

use surfel::{
    renderer::Headless,
    selftest::{CaseResult, Event, Known, KnownList, Pattern, Suite, run},
};

/// Runs the cases that match, knowing `list`; without those that are always run. `before` is called before each case.
pub fn results(
    headless: Headless,
    pattern: &str,
    list: &str,
    before: &mut dyn FnMut(&str),
) -> Vec<CaseResult> {
    let suite = Suite::new();
    let pattern = Pattern::new(pattern).unwrap();
    let cases: Vec<_> =
        suite.cases.iter().filter(|case| pattern.matches(&case.name) || case.is_always_run()).collect();
    let names = suite.cases.iter().map(|case| case.name.as_str());
    let known = Known::of_driver(vec![KnownList::parse("k.txt", list).unwrap()], "a driver", names).unwrap();
    let outcome = run(headless, &suite, &cases, &known, 2, &mut |event| match event {
        Event::Started(case) => before(&case.name),
        Event::Finished { result, .. } => println!("{}", result.line()),
    });
    assert!(outcome.lost.is_none() && outcome.results.len() == cases.len());
    outcome.results
}

pub fn result<'a>(results: &'a [CaseResult], name: &str) -> &'a CaseResult {
    results.iter().find(|result| result.name == name).unwrap()
}
