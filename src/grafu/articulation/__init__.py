"""The result type: a tree of links and joints, its kinematics and its sweep."""
