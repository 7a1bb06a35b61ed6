//! Drawings, files for ParaView and tables of an answer.

use super::{args, output::Sink};
use anyhow::bail;
use std::path::{Path, PathBuf};
use voussoir::report::{
    drawing::{self, Aspect},
    table,
    view::View,
    vtk,
};

/// What is to be made of an answer, and where it goes.
#[derive(Debug, Default)]
pub struct Pictures {
    svg: Option<Sink>,
    aspect: Aspect,
    vtk: Option<Sink>,
    /// Joints and blocks.
    csv: Option<[Sink; 2]>,
    printed: usize,
}

impl Pictures {
    /// Opens what will be written. `table` is where the table of joints goes; that of the blocks goes beside it.
    pub fn open(args: &args::Pictures, table: Option<&Path>) -> anyhow::Result<Self> {
        if let Some(path) = args.vtk.as_deref().filter(|p| !is_dash(p) && p.extension().is_none_or(|e| e != "vtp")) {
            let named = path.with_extension("vtp");
            bail!("--vtk {}: ParaView knows XML PolyData by the ending .vtp: name it {}", path.display(), named.display());
        }
        let open = |path: Option<&Path>| path.map(|p| Sink::open(Some(p))).transpose();
        let printed = [args.svg.as_deref(), args.vtk.as_deref(), table].into_iter().flatten().filter(|p| is_dash(p)).count();
        if printed > 1 {
            bail!("standard output takes one of --svg, --vtk and --csv");
        }
        let tables = match table {
            Some(path) if is_dash(path) => bail!("--csv takes a file: the table of the blocks is written beside it"),
            Some(path) => Some([Sink::open(Some(path))?, Sink::open(Some(&beside(path)))?]),
            None => None,
        };
        Ok(Self { svg: open(args.svg.as_deref())?, aspect: args.view.unwrap_or_default(), vtk: open(args.vtk.as_deref())?, csv: tables, printed })
    }

    /// Whether anything is to be made.
    pub fn wanted(&self) -> bool {
        self.svg.is_some() || self.vtk.is_some() || self.csv.is_some()
    }

    /// Whether one of them is what standard output holds.
    pub fn printed(&self) -> bool {
        self.printed > 0
    }

    /// Writes them.
    pub fn write(&self, view: &View) -> anyhow::Result<()> {
        if let Some(svg) = &self.svg {
            svg.write(&drawing::svg(view, self.aspect))?;
        }
        if let Some(vtk) = &self.vtk {
            vtk.write(&vtk::vtp(view))?;
        }
        if let Some([joints, blocks]) = &self.csv {
            joints.write(&table::joints(view).map_err(|e| anyhow::anyhow!("{e}"))?)?;
            blocks.write(&table::blocks(view).map_err(|e| anyhow::anyhow!("{e}"))?)?;
        }
        Ok(())
    }
}

fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// `forces.csv` → `forces.blocks.csv`.
fn beside(path: &Path) -> PathBuf {
    let ending = path.extension().map_or(String::new(), |e| format!(".{}", e.to_string_lossy()));
    path.with_extension(format!("blocks{ending}"))
}
