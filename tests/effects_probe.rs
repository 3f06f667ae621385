#[path = "it/effects"]
mod effects {
    mod reference;
    mod bouncing; mod faces; mod stops; mod separation;
    mod trial;
}
