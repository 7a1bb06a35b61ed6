//! What tells whether a file is the one that a record is about.

use data_encoding::HEXLOWER;

/// The SHA-256 digest (FIPS 180-4) of a file's bytes, as `sha256sum` prints it.
pub fn digest(bytes: &[u8]) -> String {
    HEXLOWER.encode(&hmac_sha256::Hash::hash(bytes))
}

#[cfg(test)]
mod tests {
    use super::digest;

    /// Values of FIPS 180-4.
    #[test]
    fn it_is_sha_256() {
        assert_eq!(
            digest(b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
        assert_eq!(digest(b""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }
}
