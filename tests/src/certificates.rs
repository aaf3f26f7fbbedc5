//! Certificates of a server and of their authority, made for a case.

use std::path::{Path, PathBuf};

use rcgen::{BasicConstraints, CertificateParams, IsCa, Issuer, KeyPair};

/// Files with the certificate and the key of a server, and with the certificate of their authority.
#[derive(Debug)]
pub struct Certificates {
    /// Certificate of the authority.
    pub authority: PathBuf,
    /// Certificate of the server.
    pub certificate: PathBuf,
    /// The server's key.
    pub key: PathBuf,
}

impl Certificates {
    /// Certificates of a server of this name or address, written into a folder.
    ///
    /// # Panics
    /// If they cannot be made.
    pub fn new(folder: &Path, server: &str) -> Self {
        let written = |name: &str, pem: String| {
            let path = folder.join(name);
            std::fs::write(&path, pem).expect("a file can be written");
            path
        };
        let mut authority = CertificateParams::new(Vec::new()).expect("valid");
        authority.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        let authority_key = KeyPair::generate().expect("a key");
        let root = authority.self_signed(&authority_key).expect("signed");
        let issuer = Issuer::new(authority, authority_key);
        let key = KeyPair::generate().expect("a key");
        let params = CertificateParams::new(vec![server.to_owned()]).expect("valid");
        let certificate = params.signed_by(&key, &issuer).expect("signed");
        Self {
            authority: written("authority.pem", root.pem()),
            certificate: written("certificate.pem", certificate.pem()),
            key: written("key.pem", key.serialize_pem()),
        }
    }
}
