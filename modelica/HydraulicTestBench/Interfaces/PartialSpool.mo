within HydraulicTestBench.Interfaces;
partial model PartialSpool "Slot for the dynamics of the valve spool"
  extends Icons.Slot;
  parameter Types.NaturalFrequency omega_v "Natural frequency";
  parameter Types.DampingRatio zeta_v "Damping ratio";
  RealInput u_ref(unit="1") "Spool command behind the dead time";
  RealOutput u(unit="1") "Spool position";
  RealOutput u_t(unit="1/s") "Spool velocity";
  RealOutput u_tt(unit="1/s2") "Spool acceleration";
  annotation(Documentation(info="<html>
<p>The law is three equations, for u, u_t and u_tt, with u and u_t as states or bounded by whatever stops the spool. The
card's inner loop and the valve's edges see this u and this u_t.</p>
<p><b>Source:</b> thesis Eq. 3.19.</p>
</html>"));
end PartialSpool;
