within HydraulicTestBench.Data;
record LockedGreyBox "Identified parameters with piston area and stroke from the data sheet, thesis Table 4.5"
  extends GreyBox(
    omega_v=2*Constants.pi*34.14,
    zeta_v=1.4461,
    L=34.2e-3,
    A_p=1260e-6,
    V_0=0.0211e-3,
    m_eff=500,
    k=17.485e3,
    b=5.609e3,
    K_p=27.493,
    K_D=1,
    T_d=0.00354,
    K_L=0.0850e-6,
    tau=5.797e-3);
  annotation(Documentation(info="<html>
<p>Fitted with stroke and area of the control piston locked to the data sheet (Table 2: 34.2 mm, 12.6 cm2).</p>
<p><b>Source:</b> thesis Table 4.5, column of final values.</p>
<p><b>Leaves out:</b> the uncertainty of the values. K_D stands on its upper bound. T_d = 0.00354 s lies below the lower
bound printed in the same table (0.005305 s): a misprint, since Table 4.6 has 0.0035368 s; the bounds of
<code>Pump.SwashPlateControl</code> are those of Table 4.6. V_0 is less than A_p L/2 (21.1 against 21.5 cm3), so a
chamber
would vanish before the end of the stroke.</p>
</html>"));
end LockedGreyBox;
