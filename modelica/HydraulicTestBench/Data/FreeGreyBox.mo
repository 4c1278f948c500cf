within HydraulicTestBench.Data;
record FreeGreyBox "Identified parameters with piston area and stroke free, thesis Table 4.6"
  extends GreyBox(
    omega_v=2*Constants.pi*28.05,
    zeta_v=0.82031,
    L=47.011e-3,
    A_p=401.33e-6,
    V_0=0.0607e-3,
    m_eff=62.384,
    k=13.445e3,
    b=13.422e3,
    K_p=42.445,
    K_D=0.24111,
    T_d=0.0040576,
    K_L=0.02e-6,
    tau=3.83e-3);
  annotation(Documentation(info="<html>
<p>Fitted with stroke and area of the control piston among the unknowns. The better of the two sets: within the limits
of
the thesis' Table 1.3 for most tests.</p>
<p><b>Source:</b> thesis Table 4.6, column of final values.</p>
<p><b>Leaves out:</b> the uncertainty of the values, which the thesis does not give. K_L stands on its lower bound, so
it
is an upper estimate rather than a value.</p>
</html>"));
end FreeGreyBox;
