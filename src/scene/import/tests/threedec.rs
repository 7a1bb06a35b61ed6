//! 3DEC: blocks from commands.

use super::{dxf::volume, *};

#[test]
fn blocks_of_every_kind_are_made() {
    let text = "; a comment\nmodel new\nblock create brick 0 2 0 1 -1 0 group \"ground\"\nblock create poly &\n  face 0,0,0 1,0,0 1,1,0 0,1,0 &\n face 0,0,1 0,1,1 1,1,1 1,0,1 &\n face 0,0,0 0,0,1 1,0,1 1,0,0 &\n  face 0,1,0 1,1,0 1,1,1 0,1,1 &\nface 0,0,0 0,1,0 0,1,1 0,0,1 &\nface 1,0,0 1,0,1 1,1,1 1,1,0 group 'stone' r=0\npoly prism a (1,0,0) (2, 0, 0) (1,1,0) b 1,0,1 2,0,1 1,1,1\nblock create tetra 5,0,0 6,0,0 5,1,0 5,0,1\nblock fix range group 'ground'\nblock property density 1800 range group 'stone'\nblock contact property friction 30\nblock fix range pos-x 0 1\n";
    let imported = good("model.dat", text);
    let blocks = &imported.scene.blocks;
    assert_eq!(ids(&imported), ["ground", "stone", "block", "block-2"]);
    let volumes: Vec<f64> = blocks.iter().map(|b| 6.0 * volume(b)).collect();
    assert_eq!(volumes.iter().map(|v| v.round()).collect::<Vec<_>>(), [12.0, 6.0, 3.0, 1.0]);
    assert_eq!(blocks.iter().filter(|b| b.support).count(), 1);
    assert_eq!(imported.scene.materials["stone"].density, 1800.0);
    let said: Vec<&str> = imported.findings.iter().map(|f| f.text.as_str()).collect();
    let said = said.join("\n");
    for part in ["\"block contact\" 1", "\"model new\" 1", "line 16", "`--support ID`"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn faults_are_refused_with_their_line() {
    for (command, why) in [
        ("block create brick 0 1 0", "two, four or six"),
        ("block create drum", "drum"),
        ("block create poly face 0,0,0 1,0,0 1,1,0", "four faces"),
        ("block create poly face 0,0,0 1,0,0 face 1,1,1 1,2,x", "got \"x\""),
        ("block create tetra 0,0,0 1,0,0 1,1,0", "four corners"),
        ("block create prism face-1 0,0,0 1,0,0 1,1,0 face-2 0,0,1 1,0,1", "as many corners"),
    ] {
        let error = import("m.3ddat", format!("\n\n{command}\n")).expect_err(command);
        let text = error.to_string();
        assert!(text.contains(why) && text.contains('3'), "{command}: {text}");
    }
}

/// The number of faces is the format's, whichever way a writer turns them.
#[test]
fn groups_are_layers() {
    let layers = [("base".to_string(), "support,density=2000".parse().expect("a rule"))].into();
    let options = ImportOptions { layers, ..ImportOptions::default() };
    let text = "block create brick 0 1 group base\nblock create brick 0 1 0 1 1 2 group top\n";
    let imported = import_bytes("m.dat", text.as_bytes(), &options).expect("a scene");
    assert_eq!(imported.scene.blocks.iter().map(|b| b.support).collect::<Vec<_>>(), [true, false]);
    assert_eq!(imported.scene.materials["base"].density, 2000.0);
}
