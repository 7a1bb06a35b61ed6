//! Completions and manuals.

use super::*;

/// Verbs of the help's list.
fn verbs() -> Vec<String> {
    let help = out(&expect(YES, voussoir(&["--help"])));
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap().to_string();
    let words = list
        .lines()
        .filter(|l| l.starts_with("  ") && !l.starts_with("   "))
        .filter_map(|l| l.split_whitespace().next());
    words.map(String::from).filter(|w| w != "help").collect()
}

#[test]
fn shells_and_manuals_know_every_verb() {
    assert!(verbs().len() >= 14, "{:?}", verbs());
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = out(&expect(YES, voussoir(&["completions", shell])));
        assert!(
            verbs().iter().all(|v| script.contains(v)) && script.contains("moving-mass"),
            "{shell}"
        );
    }
    assert!(err(&expect(USAGE, voussoir(&["completions", "sh"]))).contains("bash"));
    let desk = Desk::new();
    expect(YES, voussoir(&["man", "--folder", &desk.at("")]));
    let whole = out(&expect(YES, voussoir(&["man"])));
    for verb in verbs() {
        let page = out(&expect(YES, voussoir(&["man", &verb])));
        assert!(
            page.contains(&format!(".TH voussoir-{verb} 1")) && page.contains(".SH SYNOPSIS"),
            "{verb}"
        );
        assert_eq!(fs::read_to_string(desk.path(&format!("voussoir-{verb}.1"))).unwrap(), page);
        assert!(whole.contains(&format!("voussoir\\-{verb}(1)")), "{verb}");
    }
    assert_eq!(fs::read_to_string(desk.path("voussoir.1")).unwrap(), whole);
    assert!(whole.contains("Exit codes") && whole.contains("130"));
    expect(USAGE, voussoir(&["man", "nonsense"]));
    expect(USAGE, voussoir(&["man", "--folder", &desk.at("no/folder")]));
}
