//! Why the answer is to be believed, and what made it.

use super::{Part, Section};
use base::number::short;
use check::{
    proof::{
        Answer,
        result::{FORMAT, ResultFile},
    },
    verdict::exact::Grade,
};

/// The proof as it was found when the answer was given, and versions.
pub(super) fn sections(file: &ResultFile) -> Vec<Section> {
    let mut facts: Vec<[String; 2]> = Vec::new();
    if let Some(grade) = file.answer.proof() {
        let words = match grade {
            Grade::Exact => {
                "exact: proved for the numbers of the scene, with no allowance for rounding".into()
            }
            Grade::ToRounding(left) => {
                format!(
                    "to rounding: the proof holds to within {} (the greater, the weaker)",
                    short(left)
                )
            }
        };
        facts.push(["proved".into(), words]);
    }
    facts.extend(file.certificate.verified().iter().map(|v| ["certificate".into(), v.clone()]));
    if let Some(thrust) = &file.thrust {
        for (name, certificate) in [("least", &thrust.least), ("greatest", &thrust.greatest)] {
            facts.extend(certificate.verified().iter().map(|v| [name.into(), v.clone()]));
        }
    }
    // Each of these has a certificate of its own, which the answer in words tells.
    for (there, words) in [
        (file.critical.is_some(), "a verdict with its certificate on either side of every change"),
        (file.path.is_some(), "a certificate at every point of the curve"),
        (file.stages.is_some(), "a certificate for every stage"),
        (matches!(file.answer, Answer::Without(_)), "a certificate for every block taken out"),
        (file.against.is_some(), "a certificate for the mechanism; its motion is computed"),
    ] {
        if there {
            facts.push(["certificates".into(), words.into()]);
        }
    }
    if facts.is_empty() {
        facts.push(["proved".into(), "nothing: the certificate claims nothing".into()]);
    }
    if let Some(doubt) = &file.run.doubt {
        facts.push(["doubt".into(), format!("{}; {}", doubt.evidence, doubt.next)]);
    }
    let how = "The certificate was recomputed from the geometry of the scene alone, independently of the \
               solver. A result saved with --save contains it; voussoir check verifies it again.";
    let versions = vec![
        ["voussoir".into(), file.run.voussoir.clone()],
        ["format of results".into(), FORMAT.into()],
    ];
    vec![
        Section::new("Proof", vec![Part::Facts(facts), Part::Text(how.into())]),
        Section::new("Versions", vec![Part::Facts(versions)]),
    ]
}
