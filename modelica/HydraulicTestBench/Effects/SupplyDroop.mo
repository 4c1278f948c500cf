within HydraulicTestBench.Effects;
model SupplyDroop "Supply pressure that falls with flow (supply.droop)"
  extends Interfaces.PartialSupply(dp(start=0, fixed=true));
  parameter Real R(final unit="Pa.s/m3", min=0, max=2e11, nominal=1e10) = 0 "Fall of pressure over flow, 0 = off";
  parameter Types.Duration T(min=1e-3, max=0.2, nominal=20e-3) = 20e-3 "Lag of the fall";
equation
  T*der(dp) = R*Q - dp;
  annotation(__HydraulicTestBench(effect="supply.droop", slot="supply"), Documentation(info="<html>
<p>T d(&Delta;p)/dt + &Delta;p = R Q, with Q the signed flow through the open P edge.</p>
<p><b>Source:</b> this library; p<sub>S</sub> - &Delta;p stands for p<sub>P</sub> in thesis Eq. 3.1 and 3.2.</p>
<p><b>Valid:</b> small changes around the working point of the supply.</p>
<p><b>Leaves out:</b> limits of the supply pump, waves in the line.</p>
</html>"));
end SupplyDroop;
