//! Grains as points for ParaView, which draws them as balls (filter Glyph, scaled by `radius`).

use super::xml::Xml;
use crate::grains::Row;

/// The file.
pub fn vtp(rows: &[Row]) -> String {
    let mut xml = Xml::new("PolyData");
    let n = rows.len();
    xml.open("FieldData", "");
    xml.strings("id", rows.iter().map(|r| r.id.as_str()));
    xml.close("FieldData");
    xml.open(
        "Piece",
        &format!(
            " NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\""
        ),
    );
    xml.open("PointData", "");
    xml.numbers("radius", rows.iter().map(|r| r.radius));
    xml.numbers("mass", rows.iter().map(|r| r.mass));
    xml.integers("grain", rows.iter().map(|r| r.grain as i64));
    xml.integers("fixed", rows.iter().map(|r| i64::from(r.fixed)));
    xml.close("PointData");
    xml.open("Points", "");
    xml.vectors("points", rows.iter().map(|r| r.center));
    xml.close("Points");
    xml.open("Verts", "");
    xml.integers("connectivity", 0..n as i64);
    xml.integers("offsets", 1..=n as i64);
    xml.close("Verts");
    xml.close("Piece");
    xml.end("PolyData")
}
