"""What a fit returns: the model, how well it matches, whether it is plausible as a tire, figures."""
