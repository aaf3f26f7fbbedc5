//! Tokens of workers: each owns the leases that jobs were claimed under with it.

use super::*;

on_both_engines! { Fixture:
    a_token_renews_its_own_leases_only_and_gets_no_claims_of_another,
    a_heartbeat_has_a_state_for_each_lease_in_its_order,
    a_revoked_token_is_not_valid,
}

/// The length of a lease.
const LENGTH: Duration = Duration::from_secs(9);

fn asks(token: Option<Uuid>) -> ClaimRequest {
    ClaimRequest {
        token,
        ..request(10_000, LENGTH)
    }
}

impl Fixture {
    async fn claimed_by(&self, request: &ClaimRequest) -> Option<Lease> {
        let claims = self.store.claim(request).await.expect("the store");
        claims.first().map(Lease::from)
    }
}

async fn a_token_renews_its_own_leases_only_and_gets_no_claims_of_another(fixture: Fixture) {
    fixture.store.set_clock(0);
    let [own, other] = [Uuid::now_v7(), Uuid::now_v7()];
    for _ in 0..3 {
        fixture.queued().await;
    }
    let asked = asks(Some(own));
    let first = fixture.claimed_by(&asked).await.expect("a job");
    let foreign = fixture.claimed_by(&asks(Some(other))).await.expect("a job");
    let local = fixture.claimed_by(&asks(None)).await.expect("a job");
    let leases = [first, foreign, local];
    let owned = fixture.store.owned(own, &leases).await.expect("the store");
    assert_eq!(owned, [first]);
    let next = Lease {
        number: first.number + 1,
        ..first
    };
    let owned = fixture.store.owned(own, &[next]).await;
    assert_eq!(owned.expect("the store"), []);
    // A request that another token repeats is another one.
    let repeated = ClaimRequest {
        token: Some(other),
        ..asked
    };
    assert_eq!(fixture.claimed_by(&asked).await, Some(first));
    assert_eq!(fixture.claimed_by(&repeated).await, None);

    // Late enough to be renewed.
    fixture.store.set_clock(8_000);
    let held = LeaseState::Held {
        cancel_requested: false,
    };
    let states = fixture.store.heartbeat(&leases, LENGTH, Some(own)).await;
    let lost = LeaseState::Lost;
    assert_eq!(states.expect("the store"), [held, lost, lost]);
    assert_eq!(
        fixture.reclaimed(10_000).await,
        2,
        "those that it does not own"
    );
    let states = fixture.store.heartbeat(&leases, LENGTH, None).await;
    assert_eq!(states.expect("the store"), [held, lost, lost]);
}

async fn a_heartbeat_has_a_state_for_each_lease_in_its_order(fixture: Fixture) {
    fixture.store.set_clock(0);
    let mut leases = Vec::new();
    for _ in 0..3 {
        fixture.queued().await;
        leases.extend(fixture.claimed_by(&asks(None)).await);
    }
    fixture
        .store
        .cancel(leases[1].job)
        .await
        .expect("the store");
    let unknown = Lease {
        job: Uuid::now_v7(),
        number: 1,
    };
    let asked = [leases[2], unknown, leases[1], leases[2], leases[0]];
    let states = fixture.store.heartbeat(&asked, LENGTH, None).await;
    let held = |cancel_requested| LeaseState::Held { cancel_requested };
    let expected = [
        held(false),
        LeaseState::Lost,
        held(true),
        held(false),
        held(false),
    ];
    assert_eq!(states.expect("the store"), expected);
    let none = fixture.store.heartbeat(&[], LENGTH, None).await;
    assert_eq!(none.expect("the store"), []);
}

async fn a_revoked_token_is_not_valid(fixture: Fixture) {
    let added = fixture.store.add_worker_token("cluster", &[7; 32]).await;
    let id = added.expect("the store").id;
    let valid = async || {
        let token = fixture.store.valid_worker_token(&[7; 32]).await;
        token.expect("the store")
    };
    assert_eq!(valid().await, Some(id));
    assert!(
        fixture
            .store
            .revoke_worker_token(id)
            .await
            .expect("the store")
    );
    assert_eq!(valid().await, None);
}
