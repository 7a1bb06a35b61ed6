//! Whether the nodes of a cluster see a folder of this machine. What can be told without running
//! anything there: the kind of the file system, and whether the nodes are this machine.

use super::hosts;
use base::{error::SlurmError, files};
use std::path::Path;

/// File systems that lie on disks or in the memory of one machine. What is not named here counts as
/// shared.
const LOCAL: [&str; 20] = [
    "ext2", "ext3", "ext4", "xfs", "btrfs", "bcachefs", "zfs", "f2fs", "jfs", "reiserfs", "vfat",
    "exfat", "ntfs", "ntfs3", "tmpfs", "ramfs", "rootfs", "overlay", "squashfs", "devtmpfs",
];

/// Refuses a folder, which need not exist yet, that the nodes of a partition cannot see. Where the
/// system does not tell what is mounted, the tasks will say so.
///
/// # Errors
/// The folder lies on a disk of this machine, and a node is another one; or Slurm does not answer.
pub fn require_shared(folder: &Path, partition: &str) -> Result<(), SlurmError> {
    let parent = folder.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let read = |file: &str| files::of_system(file).unwrap_or_default();
    let Ok(parent) = parent.canonicalize() else { return Ok(()) };
    let Some(mount) = mount_of(&parent.to_string_lossy(), &read("/proc/self/mountinfo")) else {
        return Ok(());
    };
    let (this, hosts) = (read("/proc/sys/kernel/hostname"), hosts(partition)?);
    if is_shared(&mount, &hosts, this.trim()) {
        return Ok(());
    }
    let node = hosts.into_iter().find(|h| h != this.trim()).unwrap_or_default();
    Err(SlurmError::NotShared {
        folder: parent.display().to_string(),
        kind: mount.kind,
        at: mount.at,
        node,
    })
}

/// Where a file system is mounted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mount {
    /// The folder.
    pub at: String,
    /// The kind of file system.
    pub kind: String,
}

/// The mount that holds `path`, an absolute path without links, by the text of
/// `/proc/self/mountinfo` (proc(5)).
pub fn mount_of(path: &str, mountinfo: &str) -> Option<Mount> {
    let within = |at: &str| {
        at == "/" || path == at || path.strip_prefix(at).is_some_and(|rest| rest.starts_with('/'))
    };
    let mounts = mountinfo.lines().filter_map(|line| {
        let (left, right) = line.split_once(" - ")?;
        let at = unescaped(left.split(' ').nth(4)?);
        Some(Mount { at, kind: right.split(' ').next()?.to_string() })
    });
    // Of mounts on the same folder the last one counts.
    mounts.filter(|m| within(&m.at)).fold(None, |best: Option<Mount>, m| match best {
        Some(best) if best.at.len() > m.at.len() => Some(best),
        _ => Some(m),
    })
}

/// Whether all `hosts` see a folder on `mount`; `this` is the name of this machine.
pub fn is_shared(mount: &Mount, hosts: &[String], this: &str) -> bool {
    let short = |name: &str| name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    !LOCAL.contains(&mount.kind.as_str()) || hosts.iter().all(|host| short(host) == short(this))
}

/// Spaces and the like are written as three octal digits.
fn unescaped(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&first, more)) = rest.split_first() {
        let octal = more
            .get(..3)
            .filter(|_| first == b'\\')
            .and_then(|d| u8::from_str_radix(std::str::from_utf8(d).ok()?, 8).ok());
        (rest, bytes) = match octal {
            Some(byte) => (more.get(3..).unwrap_or_default(), [bytes, vec![byte]].concat()),
            None => (more, [bytes, vec![first]].concat()),
        };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::{Mount, is_shared, mount_of};

    const MOUNTS: &str = "22 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw
35 22 0:31 / /tmp rw - tmpfs tmpfs rw
36 22 0:40 / /home/big\\040data rw,relatime - nfs4 server:/export rw
37 22 0:41 / /scratch rw - lustre 10.0.0.1@tcp:/s rw
38 22 0:42 / /scratch rw - overlay overlay rw";

    #[test]
    fn local_folders_are_told_from_shared_ones() {
        let on = |path: &str| mount_of(path, MOUNTS).unwrap();
        assert_eq!(on("/home/me"), Mount { at: "/".into(), kind: "ext4".into() });
        assert_eq!(on("/home/big data/sweep").kind, "nfs4");
        assert_eq!(on("/tmpfiles").kind, "ext4");
        assert_eq!(on("/tmp/a").kind, "tmpfs");
        assert_eq!(on("/scratch/a").kind, "overlay");
        assert_eq!(mount_of("/a", "nonsense\n"), None);
        let hosts = |names: &[&str]| names.iter().map(|n| (*n).to_string()).collect::<Vec<_>>();
        assert!(is_shared(&on("/home/big data/x"), &hosts(&["n1", "n2"]), "login"));
        assert!(!is_shared(&on("/tmp/x"), &hosts(&["n1", "n2"]), "login"));
        assert!(!is_shared(&on("/tmp/x"), &hosts(&["login", "n2"]), "login"));
        assert!(is_shared(&on("/tmp/x"), &hosts(&["Login.cluster.org", "login"]), "login.local"));
    }
}
