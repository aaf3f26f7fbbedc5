//! Pages of lists: each job once, with ties and without values, whatever happens between two pages.

use sqlx::{AssertSqlSafe, Connection, Executor, PgConnection, SqliteConnection};

use super::*;

on_both_engines! { Fixture:
    pages_hold_every_job_once_whatever_happens_between_them,
}

const KEYS: [OrderKey; 8] = [
    OrderKey::Created,
    OrderKey::Name,
    OrderKey::System,
    OrderKey::Status,
    OrderKey::Progress,
    OrderKey::Wear,
    OrderKey::Life,
    OrderKey::Duration,
];
/// Names of the jobs, with ties.
const NAMES: [Option<&str>; 9] = [
    Some("b"),
    None,
    Some("A"),
    Some("a"),
    None,
    Some("B"),
    Some("c"),
    None,
    Some("a"),
];
/// Depths of those that have ended, with ties; the others have none.
const DEPTHS_MM: [f64; 5] = [0.1, 0.25, 0.1, 1.0 / 3.0, 0.1];

async fn named(fixture: &Fixture, name: Option<&str>) -> Uuid {
    let specification = br#"{"system":{"kind":"dimm"}}"#;
    let mut resolved = spec::read(specification).expect("accepted");
    resolved.spec.name = name.map(str::to_owned);
    let plan = crate::estimate::Estimate::of(&resolved).plan(&resolved, None);
    let options = SubmitOptions::default();
    let spec = resolved.spec;
    fixture
        .store
        .queue(&NewJob {
            sent: "{}".to_owned(),
            spec,
            plan,
            options,
        })
        .await
}

/// Lets a job end with a worn depth.
async fn worn(fixture: &Fixture, depth_mm: f64) {
    let claim = fixture.claimed(i64::MAX).await;
    let ended = fixture
        .store
        .end_next(&claim, &update(1), &end(Transition::Succeed))
        .await;
    assert_eq!(ended, Some(Status::Succeeded));
    let summary = format!(
        r#"{{"receptacle":{{"max_depth_mm":{depth_mm}}},"slider":{{"max_depth_mm":0.01}}}}"#
    );
    let sql = format!(
        "UPDATE jobs SET summary = '{summary}' WHERE id = '{}'",
        claim.id
    );
    let (url, sql) = (&fixture.url, AssertSqlSafe(sql));
    if url.starts_with("sqlite:") {
        let mut file = SqliteConnection::connect(url).await.expect("a file");
        file.execute(sql).await.expect("a job");
    } else {
        let mut server = PgConnection::connect(url).await.expect("a server");
        server.execute(sql).await.expect("a job");
    }
}

/// The ids of a page, and the place of its last job.
async fn page(store: &Store, filter: &Filter) -> (Vec<Uuid>, Option<ListPlace>) {
    let jobs = store.list_short(filter).await.expect("the store");
    let last = jobs.last().map(|listed| listed.place.clone());
    (jobs.iter().map(|listed| listed.job.id).collect(), last)
}

async fn pages_hold_every_job_once_whatever_happens_between_them(fixture: Fixture) {
    let store = &fixture.store;
    for name in NAMES {
        named(&fixture, name).await;
    }
    for depth_mm in DEPTHS_MM {
        worn(&fixture, depth_mm).await;
    }
    // One runs on.
    fixture.claimed(i64::MAX).await;
    let as_of_ms = store.present_ms().await.expect("the store");
    for (key, descending) in KEYS.into_iter().flat_map(|key| [(key, false), (key, true)]) {
        let order = Order { key, descending };
        let filter = |limit, after| Filter {
            order,
            after,
            as_of_ms,
            limit,
            ..Filter::default()
        };
        let (all, _) = page(store, &filter(100, None)).await;
        let count = store.count(&Filter::default()).await.expect("the store");
        assert_eq!(u64::try_from(all.len()), Ok(count));
        for limit in [1, 2, 4] {
            let (mut seen, mut after, mut added) = (Vec::new(), None, 0);
            loop {
                let (ids, last) = page(store, &filter(limit, after)).await;
                if ids.is_empty() {
                    break;
                }
                seen.extend(ids);
                after = last;
                // Another one at either end of the list, or among those without a value; one that was listed may be gone.
                if added < 3 {
                    let cancelled = named(&fixture, None).await;
                    store.cancel(cancelled).await.expect("the store");
                    added += 1;
                }
                if let Some(gone) = seen.iter().find(|id| !all.contains(id)) {
                    store.delete(*gone).await.expect("the store");
                }
            }
            seen.retain(|id| all.contains(id));
            assert_eq!(seen, all, "{order:?}, {limit} a page");
        }
        for id in listed_after(store, &all).await {
            store.delete(id).await.expect("the store");
        }
    }
}

/// The jobs that are not among others.
async fn listed_after(store: &Store, others: &[Uuid]) -> Vec<Uuid> {
    let all = Filter {
        limit: 10_000,
        ..Filter::default()
    };
    let (ids, _) = page(store, &all).await;
    ids.into_iter().filter(|id| !others.contains(id)).collect()
}
