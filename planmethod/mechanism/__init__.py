"""Structure of mechanisms: links, joints, Assur groups; no coordinates."""
