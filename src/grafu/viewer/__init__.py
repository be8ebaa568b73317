"""What people look at in a browser: a page for each model, one for a whole run. Pages need nothing outside themselves."""
