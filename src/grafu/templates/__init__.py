"""The gallery of mechanisms: parametric hinges and rails, and templates of the user's own. It installs nothing."""
