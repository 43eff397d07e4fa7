//! Shards of a sweep or an atlas, put together.

use std::path::PathBuf;

use anyhow::{Result, bail};

use super::head::Head;
use super::journal::{Points, difference};

impl<H: Head> Points<H> {
    /// Puts shards together.
    ///
    /// # Errors
    /// If they are not all shards of one sweep or atlas, each of them finished.
    pub fn merged(paths: &[PathBuf]) -> Result<Self> {
        let mut shards: Vec<Self> = paths.iter().map(|path| Self::read(path)).collect::<Result<_>>()?;
        let name = |i: usize| paths[i].display();
        let head = shards[0].head.with_shard(None);
        let mut seen = Vec::new();
        for (i, own) in shards.iter().enumerate() {
            let shard = own.head.shard();
            let Some([number, of]) = shard else { bail!("{} is a whole {}, not a shard", name(i), H::NAME) };
            if own.head.with_shard(None) != head {
                let difference = difference(&own.head, &head.with_shard(shard));
                bail!("{} and {} are of more than one {}: {difference}", name(i), name(0), H::NAME);
            }
            let parts = shards[0].head.shard().map_or(0, |[_, of]| of);
            if of != parts {
                bail!("{} is one of {of} shards, but {} is one of {parts}", name(i), name(0));
            }
            if seen.contains(&number) {
                bail!("{} is shard {number}/{of}, which is given twice", name(i));
            }
            if let Some(point) = own.missing().first() {
                bail!("{} lacks point {point}: the shard is not finished", name(i));
            }
            seen.push(number);
        }
        let of = shards[0].head.shard().map_or(0, |[_, of]| of);
        if let Some(number) = (1..=of).find(|number| !seen.contains(number)) {
            bail!("shard {number}/{of} is missing");
        }
        let mut all = shards.remove(0);
        shards.into_iter().for_each(|shard| all.append(shard));
        all.head = head;
        Ok(all)
    }
}
