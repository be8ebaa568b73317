"""What people look at in a browser: a page for each model, and one for a whole run. No page needs a network."""
